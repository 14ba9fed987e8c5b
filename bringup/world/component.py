"""The simulation as a component: the world goes on in a thread of its own, its container serves the node.

A world that is at its end (`duration`) ends the process of its container, as it would end its own.
"""

from __future__ import annotations

import os
import signal
from dataclasses import dataclass
from threading import Thread
from typing import TYPE_CHECKING

from rclpy.node import Node

from bringup.world.running import Run

if TYPE_CHECKING:
    from typing import Any


@dataclass(slots=True)
class _Unloading:
    """The wish to end, as the container brings it."""

    requested: bool = False


class Simulation(Node):  # type: ignore[misc] # rclpy is untyped
    """The node; takes the keywords of rclpy's Node. Raises `bringup.world.running.REFUSALS`."""

    def __init__(self, **options: Any) -> None:  # noqa: ANN401 - rclpy's own arguments of a node
        super().__init__(
            "simulation",
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
            **options,
        )
        self._unloading = _Unloading()
        self._run = Run(self, self._unloading)
        self._world = Thread(target=self._go, name="world")
        self._world.start()

    def destroy_node(self) -> None:
        """Stop the world and leave the graph."""
        self._unloading.requested = True
        self._world.join()
        self._run.close()
        super().destroy_node()

    def _go(self) -> None:
        self._run.go()
        if not self._unloading.requested:
            os.kill(os.getpid(), signal.SIGINT)

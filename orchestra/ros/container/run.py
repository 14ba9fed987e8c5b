"""Runs a container from its start to its end."""

from __future__ import annotations

import gc
import sys
import traceback
from typing import TYPE_CHECKING, Final

import rclpy
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from orchestra.ros.container import given, type_descriptions
from orchestra.ros.container.hosting import EXECUTABLES
from orchestra.ros.container.services import Container

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.ros.container.ending import Ending
    from orchestra.ros.container.hosting import Hosting

# The name that the containers of rclcpp_components have where nobody gives them one.
_NAME: Final = "ComponentManager"


def run(words: Sequence[str], ending: Ending) -> int:
    """Run until a signal comes or a callback fails, and return the exit status.

    An exception in a callback ends the process, as it ends a node that has a process of its own: nobody knows what
    the component would go on with, and whoever watches the container starts it again.
    """
    executable = words[1] if len(words) > 1 else ""
    if executable not in EXECUTABLES:
        sys.stderr.write(f"there is no container '{executable}': there are {', '.join(EXECUTABLES)}\n")
        return 2
    rclpy.init(args=list(words), signal_handler_options=SignalHandlerOptions.NO)
    try:
        manager = Node(_NAME)
        given.install()
        type_descriptions.install(manager)
        gc.freeze()  # what is here from the start is no garbage: looking through it takes 20 ms
        return _served(manager, executable, words, ending)
    finally:
        rclpy.try_shutdown()


def _served(manager: Node, executable: str, words: Sequence[str], ending: Ending) -> int:
    failure = Failure()
    hosting = EXECUTABLES[executable](manager, failure.note, words)
    container = Container(manager, hosting)
    failure.watch(hosting, container)
    ending.then(hosting.stop)
    hosting.spin()
    container.close()
    hosting.remove(manager)
    manager.destroy_node()
    return failure.status


class Failure:
    """What a callback has raised, if one has."""

    def __init__(self) -> None:
        self.status = 0
        self._hosting: Hosting | None = None
        self._container: Container | None = None

    def watch(self, hosting: Hosting, container: Container) -> None:
        """End this where a callback fails."""
        self._hosting, self._container = hosting, container

    def note(self, node: Node | None, error: BaseException) -> None:
        """Take note of what a callback has raised; that of a component that has gone meanwhile concerns nobody."""
        if self._hosting is None or self._container is None:
            raise error
        told = "".join(traceback.format_exception(error))
        component = self._container.component_of(node)
        if component is None and node is not None:
            node.get_logger().warning(f"a callback was at work when its component was unloaded:\n{told}")
            return
        if isinstance(error, SystemExit):
            self.status = error.code if isinstance(error.code, int) else int(error.code is not None)
        else:
            self.status = 1
            log = component.node.get_logger() if component is not None else rclpy.logging.get_logger(_NAME)
            log.fatal(f"a callback has failed, which ends the container:\n{told}")
        self._hosting.stop()

"""The three executables: whose thread calls the callbacks of a component."""

from __future__ import annotations

import os
import threading
from typing import TYPE_CHECKING, Final, Protocol

from orchestra.ros.container.spinning import Spinner

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from rclpy.node import Node

    from orchestra.ros.container.spinning import Failed

# With this word, as in rclcpp_components, each component of an isolated container has a pool of threads.
_POOLS: Final = "--use_multi_threaded_executor"
_PATIENCE: Final = 5.0


class Hosting(Protocol):
    """Calls the callbacks of nodes."""

    def add(self, node: Node) -> None:
        """Take in a node."""

    def remove(self, node: Node) -> bool:
        """Let a node go; return whether none of its callbacks is at work any more."""

    def between(self, do: Callable[[], None]) -> None:
        """Have something done while nothing of the nodes is waited for."""

    def spin(self) -> None:
        """Call callbacks until `stop`."""

    def stop(self) -> None:
        """Have `spin` return."""


class Together:
    """All nodes have one executor, with one thread or several."""

    def __init__(self, manager: Node, failed: Failed, threads: int = 1) -> None:
        self._spinner = Spinner(failed, threads)
        self.add(manager)

    def add(self, node: Node) -> None:
        """Take in a node."""
        self._spinner.add_node(node)

    def remove(self, node: Node) -> bool:
        """Let a node go; return whether none of its callbacks is at work any more."""
        return self._spinner.leave(node)

    def between(self, do: Callable[[], None]) -> None:
        """Have something done while nothing of the nodes is waited for."""
        self._spinner.between(do)

    def spin(self) -> None:
        """Call callbacks until `stop`."""
        self._spinner.spin()

    def stop(self) -> None:
        """Have `spin` return."""
        self._spinner.stop()


class Apart(Together):
    """Each component has an executor and a thread of its own."""

    def __init__(self, manager: Node, failed: Failed, threads: int) -> None:
        self._own: dict[Node, tuple[Spinner, threading.Thread]] = {}
        self._failed = failed
        self._threads = threads
        self._manager = manager
        super().__init__(manager, failed)

    def add(self, node: Node) -> None:
        """Take in a node, in a thread of its own unless it is that of the container."""
        if node is self._manager:
            super().add(node)
            return
        spinner = Spinner(self._failed, self._threads)
        spinner.add_node(node)
        thread = threading.Thread(target=spinner.spin, name=node.get_name(), daemon=True)
        self._own[node] = (spinner, thread)
        thread.start()

    def remove(self, node: Node) -> bool:
        """Let a node go, and end its thread."""
        if node not in self._own:
            return super().remove(node)
        spinner, thread = self._own.pop(node)
        free = spinner.leave(node)
        spinner.stop()
        thread.join(_PATIENCE)
        if not thread.is_alive():
            spinner.shutdown()
        return free and not thread.is_alive()

    def stop(self) -> None:
        """Have `spin` return, and all other threads end."""
        for spinner, _ in self._own.copy().values():
            spinner.stop()
        super().stop()


def _single(manager: Node, failed: Failed, _words: Sequence[str]) -> Hosting:
    return Together(manager, failed)


def _multiple(manager: Node, failed: Failed, _words: Sequence[str]) -> Hosting:
    return Together(manager, failed, threads_of(manager) + 1)  # an order may wait for callbacks to end


def _isolated(manager: Node, failed: Failed, words: Sequence[str]) -> Hosting:
    return Apart(manager, failed, threads_of(manager) if _POOLS in words else 1)


# By the name of the executable of rclcpp_components.
EXECUTABLES: Final[Mapping[str, Callable[[Node, Failed, Sequence[str]], Hosting]]] = {
    "component_container": _single,
    "component_container_mt": _multiple,
    "component_container_isolated": _isolated,
}


def threads_of(manager: Node) -> int:
    """Return how many threads a pool has: the container's parameter `thread_num`, as in rclcpp_components."""
    number = manager.declare_parameter("thread_num", max(2, len(os.sched_getaffinity(0)))).value
    return max(2, int(number or 0))

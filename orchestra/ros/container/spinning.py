"""An executor that knows whose callbacks are at work, so that a node can be taken from it when none of them is."""

from __future__ import annotations

import threading
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from rclpy.executors import (
    ConditionReachedException,
    Executor,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node
    from rclpy.task import Task

    # Hears of what a callback raised, and whose it was.
    Failed = Callable[[Node | None, BaseException], None]

# So long, in seconds, is waited for callbacks of a node that is to go.
_PATIENCE = 5.0


class Spinner(Executor):
    """Calls callbacks in the thread that spins it, or with more than one thread in a pool of them."""

    def __init__(self, failed: Failed, threads: int = 1) -> None:
        super().__init__()
        self._failed = failed
        self._pool = ThreadPoolExecutor(threads) if threads > 1 else None
        self._at_work: Counter[Node | None] = Counter()
        self._begun: dict[Task, Node | None] = {}
        self._changed = threading.Condition()
        self._stopping = threading.Event()

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for a callback and call it. Raises `ExternalShutdownException` where the context is shut down."""
        try:
            task, _entity, node = self.wait_for_ready_callbacks(timeout_sec, None, self._stopping.is_set)
        except (ConditionReachedException, ShutdownException, TimeoutException):
            return
        with self._changed:
            self._at_work[node] += 1
            self._begun[task] = node
        if self._pool is None:
            self._call(task, node)
        else:
            self._pool.submit(self._call, task, node)

    def spin(self) -> None:
        """Call callbacks until `stop`, or until the context is shut down."""
        try:
            while not self._stopping.is_set():
                self.spin_once()
        except ExternalShutdownException:
            self._stopping.set()
        if self._pool is not None:
            self._pool.shutdown(wait=False, cancel_futures=True)

    def stop(self) -> None:
        """Have `spin` return."""
        self._stopping.set()
        self.wake()

    def leave(self, node: Node) -> bool:
        """Call callbacks of a node no more. Return whether none is at work: one is waited for, but not without end."""
        self.remove_node(node)
        with self._changed:
            free = self._changed.wait_for(lambda: not self._at_work[node], _PATIENCE)
            del self._at_work[node]
            for task in [task for task, owner in self._begun.items() if owner is node]:
                del self._begun[task]
                if not task.executing():
                    task.cancel()  # a coroutine that waits for something
        node.executor = None
        return free

    def _call(self, task: Task, node: Node | None) -> None:
        """Call a callback, or go on with one that is a coroutine."""
        failure: BaseException | None = None
        try:
            task()
            failure = task.exception() if task.done() else None
        except BaseException as error:  # noqa: BLE001 - SystemExit, which a task does not keep for itself
            failure = error
        with self._changed:
            self._at_work[node] -= 1
            if task.done():
                self._begun.pop(task, None)
            self._changed.notify_all()
        if failure is not None:
            self._failed(node, failure)

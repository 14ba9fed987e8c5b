"""An executor that knows whose callbacks are at work, so that a node can be taken from it when none of them is."""

from __future__ import annotations

import threading
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from queue import Empty, SimpleQueue
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
_LOOK = 1.0


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
        self._spinning: int | None = None  # the thread
        self._between: SimpleQueue[Callable[[], None]] = SimpleQueue()

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for a callback and call it. Raises `ExternalShutdownException` where the context is shut down."""
        try:
            task, _entity, node = self.wait_for_ready_callbacks(timeout_sec, None, self._begin_to_wait)
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
        self._spinning = threading.get_ident()
        try:
            while not self._stopping.is_set():
                self.spin_once()
        except ExternalShutdownException:
            self._stopping.set()
        finally:
            self._spinning = None
            self._do_between()
        if self._pool is not None:
            self._pool.shutdown(wait=False)

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

    def between(self, do: Callable[[], None]) -> None:
        """Have something done while nothing is waited for, since a wait refers to all that is in the nodes."""
        if self._spinning in (None, threading.get_ident()):
            do()
            return
        done = threading.Event()

        def tell() -> None:
            do()
            done.set()

        self._between.put(tell)
        self.wake()
        while not done.wait(_LOOK):
            if self._spinning is None:  # it has just ended, and may not have seen this
                self._do_between()

    def _begin_to_wait(self) -> bool:
        """Do what is to be done before a wait; tell whether there is none any more. rclpy asks before each."""
        self._do_between()
        return self._stopping.is_set()

    def _do_between(self) -> None:
        while True:
            try:
                do = self._between.get_nowait()
            except Empty:
                return
            do()

    def _call(self, task: Task, node: Node | None) -> None:
        """Call a callback, or go on with one that is a coroutine."""
        failure: BaseException | None = None
        try:
            task()
        except BaseException as error:  # noqa: BLE001 - SystemExit, which a task does not keep for itself
            failure = error
        with self._changed:
            self._at_work[node] -= 1
            if self._at_work[node] <= 0:
                del self._at_work[node]
            # One that waits in the pool is handed out once more, and done only once.
            if task.done() and task in self._begun:
                del self._begun[task]
                failure = task.exception()
            self._changed.notify_all()
        if failure is not None:
            self._failed(node, failure)

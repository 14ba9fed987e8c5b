"""An executor that knows whose callbacks are at work, so that a node can be taken from it when none of them is."""

from __future__ import annotations

import threading
import time
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
from rclpy.service import Service
from rclpy.waitable import Waitable

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.node import Node
    from rclpy.task import Task

    # Hears of what a callback raised, and whose it was.
    Failed = Callable[[Node | None, BaseException], None]

# So long, in seconds, is waited for callbacks of a node that is to go.
_PATIENCE = 5.0
_LOOK = 1.0
# So long stays whose service or action has answered. Of an answer and of the end of who gave it a client hears in
# different threads, and it drops an answer of somebody who has gone. No layer of ROS tells whether a client has got it.
# Of 200 clients that stood still for 50 ms then 47 never got it, of 200 with 8 % of a processor 14; with this none did.
_LINGER = 0.1


class Spinner(Executor):
    """Calls callbacks in the thread that spins it, or with more than one thread in a pool of them."""

    def __init__(self, failed: Failed, threads: int = 1) -> None:
        super().__init__()
        self._failed = failed
        self._pool = ThreadPoolExecutor(threads) if threads > 1 else None
        self._at_work: Counter[Node | None] = Counter()
        self._begun: dict[Task, Node | None] = {}
        self._answered: dict[Node | None, float] = {}  # when
        self._changed = threading.Condition()
        self._stopping = threading.Event()
        self._spinning: int | None = None  # the thread
        self._between: SimpleQueue[Callable[[], None]] = SimpleQueue()

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for a callback and call it. Raises `ExternalShutdownException` where the context is shut down."""
        try:
            task, entity, node = self.wait_for_ready_callbacks(timeout_sec, None, self._begin_to_wait)
        except (ConditionReachedException, ShutdownException, TimeoutException):
            return
        with self._changed:
            self._at_work[node] += 1
            self._begun[task] = node
        # The result of a goal comes from a task that is nobody's.
        answers = entity is None or isinstance(entity, Service | Waitable)
        if self._pool is None:
            self._call(task, node, answers)
        else:
            self._pool.submit(self._call, task, node, answers)

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
            answered = max(self._answered.get(None, -_LINGER), self._answered.pop(node, -_LINGER))
            node.executor = None
        time.sleep(max(0.0, answered + _LINGER - time.monotonic()))
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

    def _call(self, task: Task, node: Node | None, answers: bool) -> None:
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
            if answers and (node is None or node.executor is self):
                self._answered[node] = time.monotonic()
            # One that waits in the pool is handed out once more, and done only once.
            if task.done() and task in self._begun:
                del self._begun[task]
                failure = task.exception()
            self._changed.notify_all()
        if failure is not None:
            self._failed(node, failure)

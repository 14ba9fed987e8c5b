"""What is asked of the simulation while it runs, carried out between two ticks.

Services and parameters are served in a thread of their own, which sleeps until something comes: looking for requests
from the loop of ticks would cost more than the physics. That thread touches nothing of the world; it leaves an order
and waits for its result.
"""

from __future__ import annotations

import threading
from collections import deque
from concurrent.futures import CancelledError, Future
from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

Result = TypeVar("Result")


class Orders:
    """Orders that wait for the next gap between two ticks."""

    def __init__(self) -> None:
        self._waiting: deque[Callable[[], None]] = deque()
        self._pending: set[Future[Any]] = set()
        self._lock = threading.Lock()
        self._closed = False

    def leave(self, action: Callable[[], object]) -> None:
        """Have something done soon, whatever comes of it."""
        self._waiting.append(lambda: (action(), None)[1])

    def ask(self, action: Callable[[Future[Result]], None]) -> Result:
        """Have something done and wait for the result that it sets. Raises CancelledError: the run ends before."""
        future: Future[Result] = Future()
        with self._lock:
            if self._closed:
                raise CancelledError
            self._pending.add(future)
        self._waiting.append(lambda: action(future))
        try:
            return future.result()
        finally:
            with self._lock:
                self._pending.discard(future)

    def carry_out(self) -> None:
        """Do all that waits; called between two ticks."""
        while self._waiting:
            self._waiting.popleft()()

    def close(self) -> None:
        """Let nobody wait any more."""
        with self._lock:
            self._closed = True
            for future in self._pending:
                future.cancel()

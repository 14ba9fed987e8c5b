"""The event loop that actions of users find in their context: what they give to it runs during the run.

There is no loop while launch files are resolved. Rejected: a loop that never runs, which would leave out silently what
is given to it.
"""

from __future__ import annotations

import asyncio
import atexit
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.actions.opaque_coroutine import OpaqueCoroutine
from orchestra.compat.launch.actions.opaque_function import OpaqueFunction
from orchestra.compat.launch.actions.timer_action import TimerAction

if TYPE_CHECKING:
    from collections.abc import Callable, Coroutine, Iterable

# For a run that may never be: Python complains of each that ends without one.
_waiting: Final[list[Coroutine[Any, Any, Any]]] = []


class LaterLoop:
    """Makes futures at once, and lets coroutines and callbacks be actions of the run. Nothing waits for its futures."""

    def __init__(self, visit: Callable[[Iterable[Any]], None]) -> None:
        self._visit = visit
        self._loop: Any = self  # as futures take it, which only ask for what is here

    def get_debug(self) -> bool:
        """Return whether more is looked at: no."""
        return False

    def is_running(self) -> bool:
        """Return whether it runs: not yet."""
        return False

    def create_future(self) -> asyncio.Future[Any]:
        """Return a future."""
        return asyncio.Future(loop=self._loop)

    def create_task(self, coro: Coroutine[Any, Any, Any], **_: Any) -> asyncio.Future[Any]:
        """Let a coroutine run during the run, and return the future of its result."""
        done = self.create_future()
        _waiting.append(coro)

        async def run() -> None:
            result = await coro
            _waiting.remove(coro)
            if not done.done():
                done.set_result(result)

        self._visit((OpaqueCoroutine(coroutine=run, ignore_context=True),))
        return done

    def call_soon(self, callback: Callable[..., Any], *args: Any, context: Any = None) -> asyncio.Handle:
        """Call something during the run; what waits for a future is called where that is done."""
        if args and isinstance(args[0], asyncio.Future):
            callback(*args)
            return asyncio.Handle(callback, args, self._loop, context)
        return self.call_later(0, callback, *args, context=context)

    def call_later(
        self, delay: float, callback: Callable[..., Any], *args: Any, context: Any = None
    ) -> asyncio.Handle:
        """Call something some seconds after the run has begun."""
        handle = asyncio.Handle(callback, args, self._loop, context)

        def call(_: Any) -> None:
            if not handle.cancelled():
                callback(*args)

        self._visit((TimerAction(period=float(delay), actions=[OpaqueFunction(function=call)]),))
        return handle


@atexit.register
def _let_go() -> None:
    for coroutine in _waiting:
        coroutine.close()

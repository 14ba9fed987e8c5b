"""Futures for actions of users (newer ROS releases)."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextvars import Context


class _Still:
    """A loop that never runs, for futures that are made while launch files are resolved: nothing runs then."""

    def get_debug(self) -> bool:
        """Return whether more is to be checked."""
        return False

    def call_soon(self, callback: Callable[..., object], *args: Any, context: Context | None = None) -> None:
        """Call at once what waits for a future that is done."""
        if context is None:
            callback(*args)
        else:
            context.run(callback, *args)

    def call_exception_handler(self, context: dict[str, Any]) -> None:
        """Say nothing of an exception that nobody asks a future for: nobody waits for it."""


def create_future(loop: asyncio.AbstractEventLoop | None) -> asyncio.Future[Any]:
    """Return a future of a loop; a context of a launch has none."""
    still: Any = _Still()
    return asyncio.Future(loop=still) if loop is None else loop.create_future()

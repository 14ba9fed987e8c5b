"""Servers that know their clients: rmw_fastrtps drops an answer whose reader it has not found within 100 ms.

That a client sees its server says nothing of what the server sees. A participant hears of the readers of another in the
order in which they were made, so a node that answers a client that was made last knows the ones before as well.
"""

from __future__ import annotations

import time
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from rcl_interfaces.srv import GetParameters

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_AGAIN = 1.0  # seconds


@contextmanager
def greeting(node: Any, server: str) -> Iterator[Callable[[], bool]]:
    """Yield what tells whether a server, by its full name, knows all clients that the node has made so far."""
    client = node.create_client(GetParameters, f"{server}/get_parameters")
    asked: list[tuple[float, Any]] = []

    def answered() -> bool:
        if any(answer.done() for _, answer in asked):
            return True
        if client.service_is_ready() and (not asked or time.monotonic() > asked[-1][0] + _AGAIN):
            asked.append((time.monotonic(), client.call_async(GetParameters.Request())))
        return False

    try:
        yield answered
    finally:
        node.destroy_client(client)

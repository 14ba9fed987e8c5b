"""Calls services without waiting: a question that may be asked twice is asked again where no answer comes."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

    from rclpy.client import Client
    from rclpy.node import Node
    from rclpy.task import Future

# An answer is lost where the server has not yet discovered the client's reader when it sends it (rmw_fastrtps gives
# discovery 100 ms for that), so it is asked again after this time, and then after twice as long each time up to the
# longest, so that questions do not pile up before one that hangs; in seconds.
_ASK_AGAIN = 0.5
_AT_MOST = 8.0


class Service:
    """Asks through a client, which is its maker's. `answered` of a call hears the response."""

    def __init__(self, client: Client) -> None:
        self._client = client
        self._closed = False
        self._call: Callable[[], None] | None = None
        self._again_at = 0.0
        self._patience = _ASK_AGAIN

    @property
    def asked(self) -> bool:
        """Whether an answer is awaited that may be asked for again."""
        return self._call is not None

    @property
    def ready(self) -> bool:
        """Whether a server is there."""
        return bool(self._client.service_is_ready())

    def ask(self, request: Any, answered: Callable[[Any], None], *, repeat: bool = False) -> None:  # noqa: ANN401 - as above
        """Send a request; `repeat` says that it does no harm twice."""
        pending = True

        def hear(future: Future) -> None:
            nonlocal pending
            if pending and not self._closed and not future.cancelled():
                pending = False
                self._call = None
                answered(future.result())

        def call() -> None:
            self._again_at = time.monotonic() + self._patience
            self._client.call_async(request).add_done_callback(hear)

        self._call = call if repeat else None
        self._patience = _ASK_AGAIN
        call()

    def look(self) -> None:
        """Ask again where it is time."""
        if self._call and time.monotonic() >= self._again_at:
            self._patience = min(2 * self._patience, _AT_MOST)
            self._call()

    def close(self) -> None:
        """Ask no more; what has not been answered will not be heard."""
        self._call = None
        self._closed = True


class OwnService(Service):
    """One with a client of its own, made for the service of that type and name."""

    def __init__(self, node: Node, kind: Any, name: str) -> None:  # noqa: ANN401 - a class of an untyped package
        self._node = node
        super().__init__(node.create_client(kind, name))

    def close(self) -> None:
        """Give the client back."""
        super().close()
        self._node.destroy_client(self._client)

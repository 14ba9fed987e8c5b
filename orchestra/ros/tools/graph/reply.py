"""What a service will have answered, as rclpy's future has it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable


class Reply:
    """A response that will come."""

    def __init__(self) -> None:
        self._response: Any = None
        self._heard: Callable[[Reply], None] = lambda _: None

    def add_done_callback(self, heard: Callable[[Reply], None]) -> None:
        """Have this told when it has come."""
        self._heard = heard

    def come(self, response: Any) -> None:  # noqa: ANN401 - as above
        """Take the response."""
        self._response = response
        self._heard(self)

    @staticmethod
    def cancelled() -> bool:
        """Tell whether nobody wants it any more: it is forgotten then."""
        return False

    def result(self) -> Any:  # noqa: ANN401 - as above
        """Return the response."""
        return self._response

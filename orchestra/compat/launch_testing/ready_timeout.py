"""`ready_to_test_action_timeout`: how long tests wait for their beginning."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

_FunctionT = TypeVar("_FunctionT")


def ready_to_test_action_timeout(timeout: float) -> Callable[[_FunctionT], _FunctionT]:
    """Return a decorator for `generate_test_description` that notes a number of seconds."""

    def mark(function: _FunctionT) -> _FunctionT:
        function.__ready_to_test_action_timeout__ = timeout  # type: ignore[attr-defined]  # the mark itself
        return function

    return mark

"""`post_shutdown_test`: marks tests for after the run."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

_ClassT = TypeVar("_ClassT", bound=type)


def post_shutdown_test() -> Callable[[_ClassT], _ClassT]:
    """Return a decorator for a class whose tests run when all processes have ended."""

    def mark(kind: _ClassT) -> _ClassT:
        kind.__post_shutdown_test__ = True  # type: ignore[attr-defined]  # the mark itself
        return kind

    return mark

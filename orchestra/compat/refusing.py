"""Classes whose objects launch files make: wrong arguments are reported where they stand, and code goes on.

So one mistake does not hide the next. Where code catches exceptions itself, or nobody collects problems, they are
raised as upstream does.
"""

from __future__ import annotations

import sys
from contextlib import contextmanager
from functools import wraps
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.place import NOBODY, OURS, called, is_ours
from orchestra.compat.reported import ReportedError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import FrameType

    from orchestra.errors import Problems
    from orchestra.location import Span

_ROOM: Final = __name__.rpartition(".")[0] + "."
_collectors: list[tuple[Problems, tuple[Span, ...]]] = []


@contextmanager
def collecting(problems: Problems, chain: tuple[Span, ...]) -> Iterator[None]:
    """Report wrong arguments for a while; `chain` are the includes on the way."""
    _collectors.append((problems, chain))
    try:
        yield
    finally:
        _collectors.pop()


def collector() -> tuple[Problems, tuple[Span, ...]] | None:
    """Return where problems are reported now, and the includes on the way; None where they are raised."""
    return _collectors[-1] if _collectors else None


class Refusing:
    """The root of such classes. `_refused` ones lack something that was wrong, `_lost` ones cannot be used at all."""

    _refused = False

    def _taken(self, keywords: dict[str, Any], caller: FrameType) -> bool:  # noqa: ARG002 - for subclasses
        """Take the keywords of a call that nothing is wrong with; false where the constructor has to look at them."""
        return False

    def _give_up(self) -> None:
        """Become what an object of this kind is that could not be made."""

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        constructor = vars(cls).get("__init__")
        if constructor is not None and cls.__module__.startswith(_ROOM):
            cls.__init__ = _refusing(constructor)  # type: ignore[method-assign] # the same signature

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Any:
            """Stop code that uses what could not be made. Raises `ReportedError`, else `AttributeError`."""
            kind = type(self).__name__
            if "_lost" in vars(self):
                raise ReportedError(f"this {kind} could not be made, for a reason that is reported")
            raise AttributeError(f"'{kind}' object has no attribute '{name}'", name=name, obj=self)


def is_lost(made: object) -> bool:
    """Return whether an object could not be made, which has been reported."""
    return isinstance(made, Refusing) and "_lost" in vars(made)


def _refusing(constructor: Callable[..., None]) -> Callable[..., None]:
    """Return a constructor that reports what is wrong where user code calls it."""

    @wraps(constructor)
    def construct(self: Any, *arguments: Any, **keywords: Any) -> None:
        if not _collectors:
            constructor(self, *arguments, **keywords)
            return
        caller = sys._getframe(1)
        module = caller.f_globals.get("__name__")
        # As `is_ours` does, without a call for each object.
        if module.startswith(OURS) if type(module) is str else is_ours(caller):
            constructor(self, *arguments, **keywords)
            return
        try:
            if arguments or not self._taken(keywords, caller):
                called[0] = self, caller
                constructor(self, *arguments, **keywords)
                called[0] = NOBODY
        except Exception as error:
            called[0] = NOBODY
            # Here, because only mistakes need it, and what it imports.
            from orchestra.compat.refused_arguments import settled  # noqa: PLC0415

            if not settled(self, constructor, (arguments, keywords), error, caller, *_collectors[-1]):
                raise

    return construct

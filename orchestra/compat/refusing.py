"""Classes whose objects launch files make: wrong arguments are reported where they stand, and code goes on.

So one mistake does not hide the next. Where code catches exceptions itself, or nobody collects problems, they are
raised as upstream does.
"""

from __future__ import annotations

import sys
from contextlib import contextmanager
from functools import wraps
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.place import NOBODY, Place, called, is_ours, is_own, stands
from orchestra.compat.reported import ReportedError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import CodeType, FrameType

    from orchestra.errors import Problems
    from orchestra.location import Span

_ROOM: Final = __name__.rpartition(".")[0] + "."
_collectors: list[tuple[Problems, tuple[Span, ...]]] = []
# Codes of launch files that construct something now, by their ids: all that is made by them stands there.
_constructing: dict[int, CodeType] = {}
_MOST_CODES: Final = 256
# What keeps the arguments of a call as they are given, by the class that is constructed.
_keeping: dict[type[Any], Callable[[Any, tuple[Any, ...], dict[str, Any]], bool]] = {}
_new = object.__new__
_frame = sys._getframe


@contextmanager
def collecting(problems: Problems, chain: tuple[Span, ...]) -> Iterator[None]:
    """Report wrong arguments for a while; `chain` are the includes on the way."""
    _collectors.append((problems, chain))
    try:
        yield
    finally:
        _collectors.pop()
        _constructing.clear()


@contextmanager
def standing(place: Place) -> Iterator[None]:
    """Let what is made for a while stand at a place: it makes up for what has not been made there."""
    stands.append(place)
    before = _constructing.copy()
    _constructing.clear()
    try:
        yield
    finally:
        stands.pop()
        _constructing.update(before)


def collector() -> tuple[Problems, tuple[Span, ...]] | None:
    """Return where problems are reported now, and the includes on the way; None where they are raised."""
    return _collectors[-1] if _collectors else None


class Refusing:
    """The root of such classes. `_refused` ones lack something that was wrong, `_lost` ones cannot be used at all.

    Launch files make thousands of some of them, of which few are ever asked for more than what they come to: these
    have the arguments and the keywords `_as_given`, and where that was, until somebody asks for what is made of them.
    """

    _refused = False
    _lost: tuple[Any, ...] | None = None
    _as_given: tuple[tuple[Any, ...], dict[str, Any]] | None = None
    _made_at: tuple[CodeType, int]
    _place: Place

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:  # noqa: ARG002 - for subclasses
        """Keep the arguments of a call that nothing is wrong with; false where the constructor has to look at them.

        That is for the very class that has this method, not for those of users.
        """
        return False

    def _taken(
        self,
        arguments: tuple[Any, ...],  # noqa: ARG002 - as above
        keywords: dict[str, Any],  # noqa: ARG002 - as above
        caller: FrameType,  # noqa: ARG002 - as above
    ) -> bool:
        """Keep the arguments of a call that does not stand in code of which all calls are kept, where one can."""
        return False

    @classmethod
    def _keeps(cls) -> Callable[[Any, tuple[Any, ...], dict[str, Any]], bool] | None:
        """Return what keeps the arguments of this very class; None where all are looked at."""
        return None if cls._keep is Refusing._keep else cls._keep

    def _make(self, given: tuple[tuple[Any, ...], dict[str, Any]]) -> None:
        """Do what the constructor does with arguments that were kept."""
        with standing(self._place):
            self.__init__(*given[0], **given[1])  # type: ignore[misc] # with the arguments of the subclass

    def _twin(self, given: tuple[tuple[Any, ...], dict[str, Any]]) -> Any:
        """Return what another one is, made in the same place, that does not keep these arguments."""
        made = _new(type(self))
        made._place = self._place
        made._make(given)
        return made

    def _give_up(self) -> None:
        """Become what an object of this kind is that could not be made."""

    def __init_subclass__(cls, **keywords: Any) -> None:
        super().__init_subclass__(**keywords)
        constructor = vars(cls).get("__init__")
        if not cls.__module__.startswith(_ROOM):
            return
        if constructor is not None:
            cls.__init__ = _refusing(constructor)  # type: ignore[method-assign] # the same signature
        keep = cls._keeps()
        if keep is not None:
            _keeping[cls] = keep

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Any:
            """Return what the constructor makes. Raises `ReportedError` for what could not be made.

            Raises `AttributeError` for everything else.
            """
            given = self._as_given
            if given is not None:
                if "_place" not in vars(self):
                    self._place = Place(*self._made_at, type(self))
                if name != "_place":
                    self._as_given = None
                    self._make(given)
                return getattr(self, name)
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
        caller = _frame(1)
        code = caller.f_code
        if id(code) in _constructing:
            keep = _keeping.get(type(self))
        elif not _collectors or is_ours(caller):
            constructor(self, *arguments, **keywords)
            return
        else:
            keep = _keeping.get(type(self)) if _is_noted(code) else None
        try:
            if keep is not None:
                self._made_at = code, caller.f_lasti
                if keep(self, arguments, keywords):
                    return
                del self._made_at
            elif self._taken(arguments, keywords, caller):
                return
            called[0] = self, caller
            constructor(self, *arguments, **keywords)
            called[0] = NOBODY
        except Exception as error:
            called[0] = NOBODY
            vars(self).pop("_made_at", None)
            # Here, because only mistakes need it, and what it imports.
            from orchestra.compat.refused_arguments import settled  # noqa: PLC0415

            if not settled(self, constructor, (arguments, keywords), error, caller, *_collectors[-1]):
                raise

    return construct


def _is_noted(code: CodeType) -> bool:
    """Note that a code of a launch file constructs things, where all of them stand in it."""
    if code.co_name == "__init__" or stands or is_own(code.co_filename):
        return False
    if len(_constructing) >= _MOST_CODES:
        _constructing.clear()
    _constructing[id(code)] = code
    return True

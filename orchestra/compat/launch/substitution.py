"""`launch.Substitution`: a text that is only known when the description is visited."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from orchestra.compat.described import said
from orchestra.compat.place import here, is_own
from orchestra.compat.refusing import Refusing
from orchestra.compat.reported import ReportedError
from orchestra.description.text import Call, Opaque, Template, Words
from orchestra.description.written import called, escaped

if TYPE_CHECKING:
    from types import ModuleType

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.text import Part
    from orchestra.location import Span


class Substitution(Refusing):
    """The base that users derive from: they write `perform(context)`, and `describe()` if they like.

    What a subclass performs is only known to it, so it stands in templates as an `Opaque` part. A subclass of ours
    that the launch language can say overrides `_parts` (see `orchestra.compat.calls`).

    `_known_as` says all that one is which has its arguments as they were given: a text, or the name and the arguments
    of a call; None for all others.
    """

    _known_as: Any = None

    def __str__(self) -> str:
        """Return the class: what users make texts of, as in an f-string, shows that there is no text yet."""
        frame = sys._getframe(1)
        if not is_own(frame.f_code.co_filename):
            _early().tell_written(self, frame)
        return f"<{type(self).__name__}>"

    def __bool__(self) -> bool:
        """Return true, as upstream; code that asks for that is told where it surely takes this for a text."""
        frame = sys._getframe(1)
        if not is_own(frame.f_code.co_filename):
            _early().tell_true(self, frame)
        return True

    def __eq__(self, other: object) -> bool:
        """Return whether this is the same object, as upstream; a text is never equal, which is told."""
        if isinstance(other, str) and other:
            frame = sys._getframe(1)
            if not is_own(frame.f_code.co_filename):
                _early().tell_unequal(self, other, frame)
        return self is other

    __hash__ = object.__hash__

    def describe(self) -> str:
        """Return what the substitution is, for people."""
        return self.__repr__()

    def perform(self, context: LaunchContext) -> str:
        """Return the text. Raises `NotImplementedError` in this class."""
        raise NotImplementedError(f"{type(self).__name__} does not say how it is performed")

    def _parts(self, span: Span) -> tuple[Part, ...]:
        """Return the parts of a template; they stand at `span`."""
        return (Opaque(self, span),)

    def _whole(self) -> Template | None:
        """Return the text that the substitution alone is, with a place of its own; None where that is not known."""
        return None

    def _raw(self) -> str:
        """Return the substitution as it would be written in a launch file, or else its description."""
        return said(self, Substitution)

    def _give_up(self) -> None:
        self.__class__ = LostSubstitution

    def __truediv__(self, other: Any) -> Substitution:
        """Join two parts of a path (newer ROS releases)."""
        return _Joined(self, other)

    def __rtruediv__(self, other: Any) -> Substitution:
        """Join two parts of a path (newer ROS releases)."""
        return _Joined(other, self)


class LostSubstitution(Substitution):
    """What becomes of a substitution that could not be made: a text that nobody knows; the rest is looked at."""

    def perform(self, context: LaunchContext) -> str:  # noqa: ARG002 - it does not get as far
        """Stop in silence: what is wrong has been told. Raises `ReportedError`."""
        raise ReportedError("this substitution could not be made, for a reason that is reported")

    def _raw(self) -> str:
        return ""


def _early() -> ModuleType:
    """Return what tells of substitutions that code takes for texts: only mistakes need it, and what it imports."""
    from orchestra.compat import as_texts  # noqa: PLC0415

    return as_texts


class _Joined(Substitution):
    """Two parts of a path, joined by `/`."""

    def __init__(self, left: Any, right: Any) -> None:
        self._both = (left, right)
        self._place = here(self)

    def describe(self) -> str:
        """Return the parts."""
        return "PathJoin('" + ", ".join(map(_described, self._both)) + "')"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        span = self._place.span
        return context._engine.evaluate(Template(self._parts(span), self._raw(), span))

    def _parts(self, span: Span) -> tuple[Part, ...]:
        return (Call("path-join", tuple(_template(side, span) for side in self._both), span),)

    def _raw(self) -> str:
        return called("path-join", map(_written, self._both))


def _template(side: Any, span: Span) -> Template:
    if isinstance(side, str):
        return Template((Words(side, span),), escaped(side), span)
    items = [side] if isinstance(side, Substitution) else list(side)
    parts = tuple(part for item in items for part in _parts(item, span))
    return Template(parts, _written(side), span)


def _parts(item: Any, span: Span) -> tuple[Part, ...]:
    if isinstance(item, Substitution):
        return item._parts(span)
    return (Words(item, span),)


def _written(side: Any) -> str:
    if isinstance(side, str):
        return escaped(side)
    if isinstance(side, Substitution):
        return side._raw()
    return "".join(map(_written, side))


def _described(side: Any) -> str:
    return side.describe() if isinstance(side, Substitution) else repr(side)

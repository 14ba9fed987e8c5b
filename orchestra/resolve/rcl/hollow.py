"""Parameters with nothing behind their names: braces with nothing but such names, as `{a, b}`, are one mistake."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems
from orchestra.fields import field, replace
from orchestra.location import Location
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.errors import Problem
    from orchestra.resolve.rcl.opened import OpenParameter

# In a flow mapping, where nothing else ends the key: `{rate:20.0}`.
_JOINED: Final = pattern(r"([A-Za-z_]\w*):([^\s:/]\S*)")
NO_VALUE: Final = " has no value"


@dataclass(slots=True)
class _Braces:
    """A flow mapping of parameters that is open: how deep it is, its keys, and the places of those without a value."""

    depth: int
    start: yaml.Event
    keys: list[str] = field(default_factory=list)
    empty: list[tuple[str, Location]] = field(default_factory=list)


@dataclass(slots=True)
class Hollow:
    """Reports parameters without a value."""

    problems: Problems
    open: list[_Braces] = field(default_factory=list)

    def mapping(self, event: yaml.MappingStartEvent, depth: int) -> None:
        """Take the beginning of a mapping of parameters so deep."""
        if event.flow_style:
            self.open.append(_Braces(depth, event))

    def key(self, name: str, depth: int) -> None:
        """Take the name of a parameter in a mapping so deep."""
        if self.open and self.open[-1].depth == depth:
            self.open[-1].keys.append(name)

    def value(self, parameter: OpenParameter, event: yaml.ScalarEvent, at: Location, *, listed: bool) -> None:
        """Take a scalar at a place that is no value; in a list or with a tag it is marked itself, else its key."""
        tag = event.tag if event.tag is not None and event.tag.startswith("!") else None
        if tag is None and not listed and not event.style and self.open:
            self.open[-1].empty.append((parameter.name, parameter.key))
            return
        self._tell(parameter.name, at if listed or tag else parameter.key, tag and f'"{tag}"')

    def end(self, event: yaml.Event, depth: int, at: Callable[[yaml.Event, yaml.Event], Location]) -> None:
        """Take the end of a mapping so deep; `at` gives the place from one event to another."""
        if not self.open or self.open[-1].depth != depth:
            return
        braces = self.open.pop()
        if not braces.empty or len(braces.empty) < len(braces.keys):
            for name, key in braces.empty:
                self._tell(name, key)
            return
        meant = f"[{', '.join(braces.keys)}]"
        message = "braces hold names with values: a list stands in brackets"
        self.problems.error(Code.PARAMETER_SYNTAX, message, at(braces.start, event), suggestion=meant)

    def _tell(self, name: str, at: Location, instead: str | None = None) -> None:
        if instead is None and (joined := _JOINED.fullmatch(name)) is not None:
            message = f"a blank is missing behind '{joined[1]}:'"
            self.problems.error(Code.PARAMETER_SYNTAX, message, at, suggestion=f"{joined[1]}: {joined[2]}")
            return
        message = f"the parameter '{name}'{NO_VALUE}"
        self.problems.error(Code.PARAMETER_SYNTAX, message, at, suggestion=instead)


def commented_out(problem: Problem, lines: Sequence[str]) -> Problem:
    """Return the problem of a parameter without a value with that which stands behind it as a comment."""
    span = problem.span
    if span is None or problem.suggestion is not None or not problem.message.endswith(NO_VALUE):
        return problem
    # Here, because only mistakes need it.
    from orchestra.load.eaten import EATEN, eaten  # noqa: PLC0415

    value = eaten(span, lines)
    return problem if value is None else replace(problem, message=problem.message + EATEN, suggestion=value)

"""Where values come from, in words: places with the includes on the way, and the variables that were read."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.location import Location
    from orchestra.plan.model import Via

_SETTERS: Final = {
    "default": "the default of the argument",
    "include": "given by the include",
    "command line": "given on the command line",
    "let": "set",
    "for_each": "a value of for_each",
    "environment": "set by the description",
    "parameter": "set for all nodes",
    "push": "pushed",
    "code": "set by code of the launch file",
    "caller": "of the environment in which this is called",
}
_READ: Final = {"variable": "$(var {})", "environment": "$(env {})", "parameter": "$(param {})"}
_LONGEST = 200


def place(location: Location) -> str:
    """Return a place, and the includes that led to its file."""
    return ", included from ".join(str(span) for span in (location.span, *location.included_from))


def value(data: Any) -> str:  # noqa: ANN401 - JSON
    """Return a value so that its type can be seen; the middle of a long one is left out."""
    text = json.dumps(data, ensure_ascii=False)
    return text if len(text) <= _LONGEST else f"{text[: _LONGEST - 60]} ... {text[-50:]}"


def via_lines(through: Sequence[Via]) -> Iterator[str]:
    """Yield what a value came through, a line each, what is behind another one indented below it."""
    for via in through:
        read = _READ.get(via.kind, "the namespace around it").format(via.name)
        setter = _SETTERS.get(via.setter, via.setter)
        at = f" at {place(via.location)}" if via.location is not None and via.setter != "command line" else ""
        yield f"{'  ' * via.depth}{read} is {value(via.value)}, {setter}{at}"

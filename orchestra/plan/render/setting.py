"""What a rendering may use besides the plan."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field

Paint: TypeAlias = Callable[[str, str], str]


def plain(style: str, text: str) -> str:
    """Return the text as it is: no style is shown."""
    del style
    return text


@dataclass(frozen=True, slots=True)
class Additions:
    """What a run adds to the environment of its processes on this machine.

    `variables` are set; the entries of `before` and `after` are put before and after those that a list of paths has
    already. `bare` is all that a process gets besides which inherits nothing. `files` are written for it, by their
    path below `${run}`.
    """

    variables: Mapping[str, str] = field(default_factory=dict)
    before: Mapping[str, str] = field(default_factory=dict)
    after: Mapping[str, str] = field(default_factory=dict)
    bare: Mapping[str, str] = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Setting:
    """How something is painted, and what the run adds, None where that is not to be shown.

    The styles are `strong`, `faint`, `help`, `warning` and `error`.
    """

    paint: Paint = plain
    additions: Additions | None = None

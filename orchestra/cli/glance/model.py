"""What a glance at a launch file shows."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Callable


class SeenArgument(NamedTuple):
    """A launch argument. `default` is as written, None for a required one; `constant`: it is a plain text."""

    name: str
    default: str | None
    constant: bool
    choices: tuple[str, ...]
    description: str | None
    conditional: bool


class SeenInclude(NamedTuple):
    """An include of a file that is known, and the names of the arguments that it gives."""

    path: str
    given: frozenset[str]
    conditional: bool


class Glance(NamedTuple):
    """The arguments and includes of one file, in the order of its text."""

    arguments: tuple[SeenArgument, ...] = ()
    includes: tuple[SeenInclude, ...] = ()


class Places(NamedTuple):
    """Where a file is, and where packages are."""

    path: str
    share: Callable[[str], str | None]
    prefix: Callable[[str], str | None]


class Reader(Protocol):
    """Reads one language. Raises `ValueError`, `SyntaxError` or `RecursionError` for what is no such text."""

    def __call__(self, text: str, places: Places, /) -> Glance:
        """Return what the text shows."""

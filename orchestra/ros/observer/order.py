"""What every order to the observer can do: one file per kind, one table of them in `observe`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol, TypeAlias

# Says a word to the order, with what belongs to it: `say("done", state="active")`.
Say: TypeAlias = Callable[..., None]
Request: TypeAlias = Mapping[str, Any]


class Order(Protocol):
    """An order that is being carried out. It says `done` or `impossible` at its end, unless it is closed before."""

    @property
    def looks(self) -> bool:
        """Whether the graph is to be looked at for it, again and again."""

    def look(self) -> None:
        """Look at the graph."""

    def close(self) -> None:
        """Give back what belongs to it."""

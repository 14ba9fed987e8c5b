"""What every order to the observer can do: one file per kind, one table of them in `kinds`."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Protocol, TypeAlias

# Says a word to the order, with what belongs to it: `say("done", state="active")`.
Say: TypeAlias = Callable[..., None]
Request: TypeAlias = Mapping[str, Any]

# How often the graph is looked at for what is awaited, in seconds: rclpy shows no graph event.
OFTEN = 0.1


class ImpossibleError(Exception):
    """An order cannot be carried out; the text says why, for users. Any step of an order may raise it."""


class Order(Protocol):
    """An order that is being carried out. It says `done` or `impossible` at its end, unless it is closed before."""

    @property
    def every(self) -> float | None:
        """After how many seconds `look` is called again; None while there is nothing to look at."""

    def look(self) -> None:
        """Look at the graph, or at what has come since."""

    def close(self) -> None:
        """Give back what belongs to it."""

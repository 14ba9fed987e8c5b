"""The table of formats: a module of this room each, imported when it is used."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Final, Protocol

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.cli.colour import Paint
    from orchestra.cli.problems.sources import Sources
    from orchestra.errors import Problem


class Renderer(Protocol):
    """Turns problems into the text of one format, line break at its end included."""

    def __call__(self, problems: Sequence[Problem], sources: Sources, paint: Paint, /) -> str:
        """Return the text."""


FORMATS: Final = ("github", "json", "sarif", "text")


def renderer(name: str) -> Renderer:
    """Return what renders a format of the table."""
    render: Renderer = import_module(f"orchestra.cli.problems.{name}").render
    return render

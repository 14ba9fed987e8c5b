"""The table of formats."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from orchestra.cli.problems import github, json, sarif, text

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.cli.colour import Paint
    from orchestra.cli.problems.sources import Sources
    from orchestra.errors import Problem


class Renderer(Protocol):
    """Turns problems into the text of one format, line break at its end included."""

    def __call__(self, problems: Sequence[Problem], sources: Sources, paint: Paint, /) -> str:
        """Return the text."""


FORMATS: dict[str, Renderer] = {
    "text": text.render,
    "json": json.render,
    "github": github.render,
    "sarif": sarif.render,
}

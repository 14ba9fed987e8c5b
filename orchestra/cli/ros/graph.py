"""`orchestra graph`: which nodes talk on which topics, as text or as a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.parser import CommandParser
from orchestra.cli.ros.asking import become
from orchestra.cli.ros.options import flag, graph

if TYPE_CHECKING:
    from argparse import Namespace

_FORMATS: Final = ("text", "json", "mermaid", "dot", "svg")
_EPILOG: Final = """\
A dashed arrow leads to a subscription that no publisher of the topic fits: 'orchestra doctor' says why. An SVG is drawn
by Graphviz, which has to be installed; Mermaid is drawn by browsers and editors.
"""


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("graph", "Draw which nodes talk on which topics.", _EPILOG)
    made.add_argument("--format", choices=_FORMATS, default="text", help="how to write it (default: text)")
    made.add_argument(
        "--node",
        action="append",
        default=[],
        metavar="GLOB",
        help="only these nodes and their topics, as /robot1/*; may be repeated",
    )
    flag("-a", "--all", tell="hidden ones too, and the topics that every node has")(made)
    graph(made)
    return made


def run(options: Namespace) -> int:
    """Draw it."""
    become("graph", "picture:show", options)

"""`orchestra tf`: the transforms between frames."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import counting, graph, positive, seconds, word
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser

_WAIT: Final = 2.0
_PDF: Final = "frames.pdf"


def _echoing(parser: CommandParser) -> None:
    parser.add_argument(
        "-r", "--rate", type=positive, default=1.0, metavar="N", help="so often a second (default: 1)"
    )
    how_many = parser.add_mutually_exclusive_group()
    how_many.add_argument("--once", action="store_true", help="end after the first one")
    how_many.add_argument("-n", "--count", type=counting, metavar="N", help="end after so many")
    parser.add_argument(
        "--timeout", type=seconds, metavar="SECONDS", help="wait no longer for them (default: without end)"
    )


def _drawing(parser: CommandParser) -> None:
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--dot", action="store_true", help="as a graph in the language of Graphviz")
    how.add_argument("--svg", action="store_true", help="as a picture, which Graphviz draws")
    how.add_argument(
        "--pdf",
        nargs="?",
        const=_PDF,
        metavar="FILE",
        help=f"as a PDF, which Graphviz draws (default: {_PDF})",
    )
    parser.add_argument(
        "--wait",
        type=seconds,
        default=_WAIT,
        metavar="SECONDS",
        help=f"listen so long to those who publish transforms (default: {_WAIT:g})",
    )


_VERBS: Final = {
    "echo": Verb(
        "show where one frame is in another",
        "transforms:echo",
        (
            graph,
            word("source", "the frame in which it is told"),
            word("target", "the frame that is told of"),
            _echoing,
        ),
    ),
    "tree": Verb("show all frames", "frame_tree:tree", (graph, _drawing)),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("tf", "Show transforms between frames.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("tf", _VERBS[options.verb], options)

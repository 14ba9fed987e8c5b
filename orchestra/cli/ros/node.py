"""`orchestra node`: the nodes in the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import flag, graph, word
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

_VERBS: Final = {
    "list": Verb(
        "list the nodes",
        "nodes:list_nodes",
        (
            graph,
            flag("-a", "--all", tell="hidden ones too"),
            flag("-c", "--count-nodes", tell="only how many there are"),
        ),
    ),
    "info": Verb(
        "show the topics, services and actions of a node",
        "node_info:info",
        (
            graph,
            word("node", "its full name"),
            flag("--include-hidden", tell="hidden topics, services and actions too"),
        ),
    ),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("node", "Show the nodes that run.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("node", _VERBS[options.verb], options)

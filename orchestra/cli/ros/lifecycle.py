"""`orchestra lifecycle`: the states of nodes that have a lifecycle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import flag, graph, timeout, word
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

_HIDDEN: Final = flag("--include-hidden-nodes", tell="hidden nodes too")
_TIME: Final = timeout(10.0, "wait so long for the node to answer")
_VERBS: Final = {
    "nodes": Verb(
        "list the nodes with a lifecycle",
        "lifecycle:list_nodes",
        (
            graph,
            flag("-a", "--all", tell="hidden ones too"),
            flag("-c", "--count-nodes", tell="only how many there are"),
        ),
    ),
    "get": Verb(
        "show the state of a node, or of all",
        "lifecycle:get",
        (graph, word("node", "its full name (default: all of them)", optional=True), _HIDDEN, _TIME),
    ),
    "list": Verb(
        "list the transitions that a node can make",
        "lifecycle:list_transitions",
        (
            graph,
            word("node", "its full name"),
            flag("-a", "--all", tell="those of other states too"),
            _HIDDEN,
            _TIME,
        ),
    ),
    "set": Verb(
        "make a node change its state",
        "lifecycle:set_state",
        (
            graph,
            word("node", "its full name"),
            word("transition", "by its name, as configure, or its number"),
            _HIDDEN,
            _TIME,
        ),
    ),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("lifecycle", "Show and change the states of lifecycle nodes.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("lifecycle", _VERBS[options.verb], options)

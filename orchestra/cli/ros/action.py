"""`orchestra action`: the actions in the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import flag, graph, timeout, values, word
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

_TYPES: Final = flag("-t", "--show-types", tell="with their types")
_VERBS: Final = {
    "list": Verb(
        "list the actions",
        "actions:list_actions",
        (graph, _TYPES, flag("-c", "--count-actions", tell="only how many there are")),
    ),
    "info": Verb(
        "show which nodes have clients and servers of an action",
        "actions:info",
        (graph, word("action", "its name"), _TYPES, flag("-c", "--count", tell="only how many there are")),
    ),
    "type": Verb("show the type of an action", "actions:action_type", (graph, word("action", "its name"))),
    "send_goal": Verb(
        "send a goal to an action",
        "goals:send_goal",
        (
            graph,
            word("action", "its name"),
            word("type", "as example_interfaces/action/Fibonacci"),
            values("goal", "in YAML, as '{order: 5}'"),
            flag("-f", "--feedback", tell="show the feedback too"),
            timeout(None, "wait so long for the server and the result"),
        ),
    ),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("action", "Show actions and send goals to them.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("action", _VERBS[options.verb], options)

"""`orchestra param`: the parameters of running nodes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import flag, graph, timeout, word
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser

_TIME: Final = 5.0


def _choosing(parser: CommandParser) -> None:
    parser.add_argument(
        "--filter", metavar="RE", help="only names that begin as this regular expression says"
    )
    parser.add_argument(
        "--param-prefixes", nargs="+", default=[], metavar="PREFIX", help="only names below these"
    )


def _names(parser: CommandParser) -> None:
    parser.add_argument("names", nargs="+", metavar="NAME", help="of the parameters")


_HIDDEN: Final = flag("--include-hidden-nodes", tell="hidden nodes too")
_COMMON: Final = (graph, _HIDDEN, timeout(_TIME, "wait so long for the node and its answer"))
_NODE: Final = word("node", "its full name")
_NAME: Final = word("name", "of the parameter")
_VERBS: Final = {
    "list": Verb(
        "list the parameters of a node, or of all",
        "parameter_files:list_parameters",
        (
            *_COMMON,
            word("node", "its full name (default: all of them)", optional=True),
            _choosing,
            flag("--param-type", tell="with their types"),
        ),
    ),
    "get": Verb(
        "show the value of a parameter",
        "parameters:get",
        (*_COMMON, _NODE, _NAME, flag("--hide-type", tell="only the value")),
    ),
    "set": Verb(
        "set a parameter",
        "parameters:set_one",
        (*_COMMON, _NODE, _NAME, word("value", "in YAML: '!!str 1' is a string")),
    ),
    "describe": Verb(
        "show what a node says of its parameters", "parameters:describe", (*_COMMON, _NODE, _names)
    ),
    "dump": Verb(
        "write all parameters of a node as a parameter file", "parameter_files:dump", (*_COMMON, _NODE)
    ),
    "load": Verb(
        "set the parameters of a node that are in a file",
        "parameter_files:load",
        (
            *_COMMON,
            _NODE,
            word("file", "a parameter file"),
            flag("--no-use-wildcard", tell="not what stands in it for all nodes (/**)"),
        ),
    ),
    "delete": Verb("undeclare a parameter", "parameters:delete", (*_COMMON, _NODE, _NAME)),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("param", "Show and set parameters of running nodes.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("param", _VERBS[options.verb], options)

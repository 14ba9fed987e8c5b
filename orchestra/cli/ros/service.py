"""`orchestra service`: the services in the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import flag, graph, positive, timeout, values, word
from orchestra.cli.ros.topic_options import showing
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser


def _rate(parser: CommandParser) -> None:
    parser.add_argument(
        "-r", "--rate", type=positive, metavar="N", help="call it again and again, N times a second"
    )


_HIDDEN: Final = flag("--include-hidden-services", tell="hidden ones too")
_COUNT: Final = flag("-c", "--count-services", tell="only how many there are")
_VERBS: Final = {
    "list": Verb(
        "list the services",
        "services:list_services",
        (graph, flag("-t", "--show-types", tell="with their types"), _COUNT, _HIDDEN),
    ),
    "type": Verb("show the type of a service", "services:service_type", (graph, word("service", "its name"))),
    "info": Verb(
        "show the type of a service and how many clients and servers it has",
        "services:info",
        (graph, word("service", "its name")),
    ),
    "find": Verb(
        "list the services of a type",
        "services:find",
        (graph, word("type", "as std_srvs/srv/SetBool"), _COUNT, _HIDDEN),
    ),
    "echo": Verb(
        "show the requests and responses of a service",
        "service_events:echo",
        (
            graph,
            word("service", "its name"),
            word("type", "(default: the one that it has)", optional=True),
            showing,
        ),
    ),
    "call": Verb(
        "call a service",
        "services:call",
        (
            graph,
            word("service", "its name"),
            word("type", "as std_srvs/srv/SetBool"),
            values("values", "of the request, in YAML, as '{data: true}'"),
            _rate,
            timeout(None, "wait so long for the service and its response"),
        ),
    ),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("service", "Show and call services.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("service", _VERBS[options.verb], options)

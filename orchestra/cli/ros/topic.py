"""`orchestra topic`: the topics in the graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import flag, graph, word
from orchestra.cli.ros.topic_options import echoing, publishing, window
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser


def _filter(parser: CommandParser) -> None:
    parser.add_argument("--filter", metavar="EXPR", help="only messages m for which this holds, in Python")


_HIDDEN: Final = flag("--include-hidden-topics", tell="hidden ones too")
_COUNT: Final = flag("-c", "--count-topics", tell="only how many there are")
_TOPIC: Final = word("topic", "its name")
_VERBS: Final = {
    "list": Verb(
        "list the topics",
        "topics:list_topics",
        (
            graph,
            flag("-t", "--show-types", tell="with their types"),
            _COUNT,
            flag("-v", "--verbose", tell="with types, and numbers of publishers and subscriptions"),
            _HIDDEN,
        ),
    ),
    "info": Verb(
        "show the type and the ends of a topic",
        "topics:info",
        (graph, _TOPIC, flag("-v", "--verbose", tell="with nodes and QoS"), _HIDDEN),
    ),
    "type": Verb("show the type of a topic", "topics:topic_type", (graph, _TOPIC, _HIDDEN)),
    "find": Verb(
        "list the topics of a type",
        "topics:find",
        (graph, word("type", "as std_msgs/msg/String"), _COUNT, _HIDDEN),
    ),
    "echo": Verb(
        "show the messages of a topic",
        "echo:echo",
        (graph, _TOPIC, word("type", "(default: the one that it has)", optional=True), _HIDDEN, echoing),
    ),
    "pub": Verb(
        "publish a message",
        "publishing:publish",
        (graph, _TOPIC, word("type", "as std_msgs/msg/String"), _HIDDEN, publishing),
    ),
    "hz": Verb(
        "show how often messages come",
        "rates:hz",
        (
            graph,
            _TOPIC,
            _HIDDEN,
            window(10_000),
            _filter,
            flag("--wall-time", tell="measure in real time, also where /clock is used"),
        ),
    ),
    "bw": Verb("show how much comes in", "rates:bw", (graph, _TOPIC, _HIDDEN, window(100))),
    "delay": Verb(
        "show how old messages are when they come", "rates:delay", (graph, _TOPIC, _HIDDEN, window(10_000))
    ),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("topic", "Show topics and their messages, and publish some.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("topic", _VERBS[options.verb], options)

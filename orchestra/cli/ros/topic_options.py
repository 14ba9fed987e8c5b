"""The options of `topic echo`, `topic pub` and the measuring verbs."""

from __future__ import annotations

from argparse import Action
from typing import TYPE_CHECKING

from orchestra.cli.ros.options import counting, natural, positive, qos, seconds
from orchestra.cli.ros.options import values as yaml_values

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable

    from orchestra.cli.parser import CommandParser

_LENGTH = 128


class _Length(Action):
    """Takes the length, and that it was given: JSON is whole unless somebody wants otherwise."""

    def __call__(
        self,
        parser: ArgumentParser,  # noqa: ARG002 - argparse's
        namespace: Namespace,
        values: object,
        option_string: str | None = None,  # noqa: ARG002 - as above
    ) -> None:
        namespace.truncate_length = namespace.truncate_given = values


def echoing(parser: CommandParser) -> None:
    """Add the options of `topic echo`."""
    qos(parser)
    showing(parser)
    parser.add_argument("--field", metavar="PATH", help="only this part of each message, as pose.position.x")
    for name, tell in (
        ("no-lost-messages", "do not tell of messages that were lost"),
        ("raw", "the bytes of each message"),
    ):
        parser.add_argument(f"--{name}", action="store_true", help=tell)
    parser.add_argument("--filter", metavar="EXPR", help="only messages m for which this holds, in Python")


def showing(parser: CommandParser) -> None:
    """Add how many messages are shown, and how."""
    parser.add_argument("--csv", action="store_true", help="the values of each message in one line")
    parser.add_argument("-f", "--full-length", action="store_true", help="all of long arrays and texts")
    parser.add_argument(
        "-l",
        "--truncate-length",
        type=natural,
        default=_LENGTH,
        action=_Length,
        metavar="N",
        help=f"so much of long arrays and texts (default: {_LENGTH})",
    )
    parser.set_defaults(truncate_given=None)
    for name, tell in (
        ("no-arr", "leave arrays out"),
        ("no-str", "leave texts out"),
        ("flow-style", "arrays and mappings in one line"),
    ):
        parser.add_argument(f"--{name}", action="store_true", help=tell)
    how_many = parser.add_mutually_exclusive_group()
    how_many.add_argument("--once", action="store_true", help="end after the first one")
    how_many.add_argument("-n", "--count", type=counting, metavar="N", help="end after so many")
    parser.add_argument("--timeout", type=seconds, metavar="SECONDS", help="end after this time")
    parser.add_argument(
        "-i",
        "--include-message-info",
        action="store_true",
        help="times and numbers that the middleware gives each message",
    )


def publishing(parser: CommandParser) -> None:
    """Add the options of `topic pub`."""
    yaml_values("values", "of the message, in YAML, as '{data: hello}'")(parser)
    qos(parser)
    parser.add_argument(
        "-r", "--rate", type=positive, default=1.0, metavar="N", help="so often a second (default: 1)"
    )
    parser.add_argument(
        "-p", "--print", type=natural, default=1, metavar="N", help="show each N-th (default: 1; 0: none)"
    )
    how_many = parser.add_mutually_exclusive_group()
    how_many.add_argument("-1", "--once", action="store_true", help="end after one")
    how_many.add_argument("-t", "--times", type=natural, default=0, metavar="N", help="end after so many")
    parser.add_argument(
        "-w",
        "--wait-matching-subscriptions",
        type=natural,
        metavar="N",
        help="wait for so many subscriptions first (default: 1 where it ends, else 0)",
    )
    parser.add_argument("--max-wait-time-secs", type=seconds, metavar="S", help="wait for them no longer")
    parser.add_argument(
        "--keep-alive", type=seconds, default=0.1, metavar="S", help="stay so long at the end (default: 0.1)"
    )
    parser.add_argument("-n", "--node-name", metavar="NAME", help="the name of the node that publishes")


def window(default: int) -> Callable[[CommandParser], None]:
    """Return what adds the number of messages that count."""

    def add(parser: CommandParser) -> None:
        parser.add_argument(
            "-w",
            "--window",
            type=counting,
            default=default,
            metavar="N",
            help=f"measure over the last N messages (default: {default})",
        )

    return add

"""Options that several verbs have, under the names that they have in the ROS 2 tools."""

from __future__ import annotations

from argparse import ArgumentTypeError
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.cli.parser import CommandParser

    Options = Callable[[CommandParser], None]

_SPIN_TIME: Final = 3.5
_PROFILES: Final = (
    *("unknown", "system_default", "sensor_data", "services_default", "parameters"),
    *("parameter_events", "action_status_default", "best_available"),
)


def graph(parser: CommandParser) -> None:
    """What every verb has that looks at the graph."""
    parser.add_argument(
        "--spin-time",
        type=seconds,
        default=_SPIN_TIME,
        metavar="SECONDS",
        help=f"where the answer is not complete, look until nothing new comes for so long (default: {_SPIN_TIME})",
    )
    parser.add_argument("-s", "--use-sim-time", action="store_true", help="take the time from /clock")
    parser.add_argument("--no-daemon", action="store_true", help="nothing: there is no daemon")


def flag(*names: str, tell: str) -> Options:
    """Return what adds a flag."""

    def add(parser: CommandParser) -> None:
        parser.add_argument(*names, action="store_true", help=tell)

    return add


def word(name: str, tell: str, *, optional: bool = False) -> Options:
    """Return what adds a word that is no option."""

    def add(parser: CommandParser) -> None:
        parser.add_argument(name, nargs="?" if optional else None, metavar=name.upper(), help=tell)

    return add


def timeout(default: float | None, tell: str) -> Options:
    """Return what adds a time to wait."""
    shown = "without end" if default is None else f"{default:g}"

    def add(parser: CommandParser) -> None:
        parser.add_argument(
            "--timeout", type=seconds, default=default, metavar="SECONDS", help=f"{tell} (default: {shown})"
        )

    return add


def values(name: str, tell: str) -> Options:
    """Return what adds values in YAML, given as a word or on standard input."""

    def add(parser: CommandParser) -> None:
        parser.add_argument(name, nargs="?", default="{}", metavar=name.upper(), help=tell)
        parser.add_argument("--stdin", action="store_true", help="read them from standard input")

    return add


def qos(parser: CommandParser) -> None:
    """Add what a profile and its policies are given by."""
    parser.add_argument("--qos-profile", choices=_PROFILES, help="a profile by its name")
    parser.add_argument("--qos-depth", type=natural, metavar="N", help="how many messages are kept")
    policies = {
        "history": ("system_default", "keep_last", "keep_all", "unknown"),
        "reliability": ("system_default", "reliable", "best_effort", "unknown", "best_available"),
        "durability": ("system_default", "transient_local", "volatile", "unknown", "best_available"),
        "liveliness": ("system_default", "automatic", "manual_by_topic", "unknown", "best_available"),
    }
    for policy, words in policies.items():
        parser.add_argument(f"--qos-{policy}", choices=words, help=f"the policy of {policy}")
    parser.add_argument(
        "--qos-liveliness-lease-duration-seconds",
        type=seconds,
        metavar="SECONDS",
        help="the time within which a publisher shows that it lives",
    )


def seconds(text: str) -> float:
    """Return a time that is not negative."""
    try:
        number = float(text)
    except ValueError:
        number = -1.0
    if not 0 <= number < float("inf"):
        raise ArgumentTypeError(f"'{text}' is no time in seconds")
    return number


def positive(text: str) -> float:
    """Return a number above zero."""
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not 0 < number < float("inf"):
        raise ArgumentTypeError(f"'{text}' is no number above 0")
    return number


def natural(text: str) -> int:
    """Return a whole number that is not negative."""
    if not text.isdecimal():
        raise ArgumentTypeError(f"'{text}' is no whole number")
    return int(text)


def counting(text: str) -> int:
    """Return a whole number from 1 on."""
    number = natural(text)
    if number < 1:
        raise ArgumentTypeError(f"'{text}' is less than 1")
    return number

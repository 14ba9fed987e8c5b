"""`orchestra doctor`: what is wrong in the running graph."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.parser import CommandParser
from orchestra.cli.ros.asking import become
from orchestra.cli.ros.options import graph, seconds

if TYPE_CHECKING:
    from argparse import Namespace

_LISTEN: Final = 2.0
_ANSWER: Final = 5.0
# In the order in which they are made; `orchestra.ros.tools.doctor.checks` has what is looked at.
CHECKS: Final = {
    "qos": "publishers and subscriptions whose QoS does not fit",
    "types": "topics and services with two types, types with two definitions",
    "unmatched": "topics that nobody feeds or reads beside one with nearly the same name",
    "names": "nodes with one name",
    "answers": "nodes that do not answer",
    "time": "nodes of which some take their time from /clock and others do not",
    "clock": "more than one /clock, a clock that jumps",
    "frames": "transforms with two parents, in a circle, with gaps, too old",
    "settings": "domain, middleware and discovery that differ between the nodes of a run",
}


def parser() -> CommandParser:
    """Return what the command understands."""
    rows = "".join(f"  {name:<10} {tell}\n" for name, tell in CHECKS.items())
    epilog = f"checks:\n{rows}\nThe exit status is 0 where nothing is wrong, and 1 where something is.\n"
    made = CommandParser("doctor", "Say what is wrong in the running graph.", epilog)
    made.add_argument(
        "--format", choices=("text", "json"), default="text", help="how to write it (default: text)"
    )
    report = made.add_mutually_exclusive_group()
    report.add_argument(
        "-r",
        "--report",
        action="store_true",
        help="tell of the machine, the middleware and the whole graph too",
    )
    report.add_argument(
        "-rf", "--report-failed", action="store_true", help="the same, but only where something is wrong"
    )
    made.add_argument(
        "-ep", "--exclude-packages", action="store_true", help="nothing: no versions are compared"
    )
    made.add_argument("-iw", "--include-warnings", action="store_true", help="nothing: all is told")
    which = made.add_mutually_exclusive_group()
    which.add_argument(
        "--only", action="append", default=[], choices=CHECKS, metavar="CHECK", help="only this check"
    )
    which.add_argument(
        "--skip", action="append", default=[], choices=CHECKS, metavar="CHECK", help="not this check"
    )
    made.add_argument(
        "--listen",
        type=seconds,
        default=_LISTEN,
        metavar="SECONDS",
        help=f"hear /clock and transforms for so long, where there are any (default: {_LISTEN:g})",
    )
    made.add_argument(
        "--timeout",
        type=seconds,
        default=_ANSWER,
        metavar="SECONDS",
        help=f"wait so long for a node to answer (default: {_ANSWER:g})",
    )
    graph(made)
    return made


def run(options: Namespace) -> int:
    """Examine it."""
    options.checks = [
        name for name in CHECKS if name in (options.only or CHECKS) and name not in options.skip
    ]
    become("doctor", "doctor.examining:examine", options)

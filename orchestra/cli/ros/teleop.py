"""`orchestra teleop`: drive a robot with the keys."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli.parser import CommandParser
from orchestra.cli.ros.asking import become
from orchestra.cli.ros.options import graph, positive

if TYPE_CHECKING:
    from argparse import Namespace

_EPILOG = """\
Nothing is published before the first key. The command of the last one is published again and again until another key
is pressed, since robots stop where commands cease to come; with --key-timeout, until no key has been pressed for so
long. The end, however it comes, is a stop. Keys are read from standard input, which may be a pipe.
"""


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("teleop", "Drive a robot with the keys.", _EPILOG)
    made.add_argument("-n", "--namespace", default="", metavar="NAMESPACE", help="of the robot, as /robot1")
    made.add_argument(
        "-t", "--topic", default="cmd_vel", metavar="TOPIC", help="for the commands (default: cmd_vel)"
    )
    made.add_argument(
        "--stamped", action="store_true", help="publish TwistStamped (default: the type that the topic has)"
    )
    made.add_argument("--frame-id", default="", metavar="FRAME", help="in the header, with --stamped")
    for name, default, unit in (("speed", 0.5, "m/s"), ("turn", 1.0, "rad/s")):
        made.add_argument(
            f"--{name}", type=positive, default=default, metavar="N", help=f"in {unit} (default: {default:g})"
        )
        made.add_argument(
            f"--max-{name}", type=positive, default=1e9, metavar="N", help=f"no key takes it above, in {unit}"
        )
    made.add_argument(
        "-r", "--rate", type=positive, default=10.0, metavar="HZ", help="so often a second (default: 10)"
    )
    made.add_argument(
        "--key-timeout", type=positive, metavar="SECONDS", help="stop where no key is pressed for so long"
    )
    made.add_argument(
        "--format", choices=("text", "json"), default="text", help="how to write it (default: text)"
    )
    graph(made)
    return made


def run(options: Namespace) -> int:
    """Drive."""
    become("teleop", "teleop:teleop", options)

"""`orchestra bag`: recording of messages, and playing them again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.options import natural, positive, seconds, word
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.cli.parser import CommandParser

_SPIN_TIME: Final = 3.5
_CLOCK_RATE: Final = 40.0


def _choosing(parser: CommandParser) -> None:
    parser.add_argument("--topics", nargs="+", default=[], metavar="TOPIC", help="these topics")
    parser.add_argument(
        "-e", "--regex", metavar="RE", help="topics in which this regular expression is found"
    )
    parser.add_argument("-x", "--exclude-regex", metavar="RE", help="none in which this is found")
    parser.add_argument(
        "--exclude-topics", nargs="+", default=[], metavar="TOPIC", help="none of these topics"
    )
    # These commands take no time from /clock.
    parser.set_defaults(use_sim_time=False, spin_time=_SPIN_TIME)


def _recording(parser: CommandParser) -> None:
    parser.add_argument("names", nargs="*", metavar="TOPIC", help="the topics to record")
    parser.add_argument("-a", "--all", "--all-topics", action="store_true", help="all topics")
    parser.add_argument("-o", "--output", metavar="FOLDER", help="where to (default: rosbag2_ and the time)")
    parser.add_argument("-s", "--storage", choices=["mcap"], default="mcap", help="there is no other")
    parser.add_argument(
        "--compression", choices=["none", "lz4", "zstd"], default="none", help="of the file (default: none)"
    )
    parser.add_argument("--duration", type=positive, metavar="SECONDS", help="end after this time")
    parser.add_argument(
        "-b",
        "--max-bag-size",
        type=natural,
        default=0,
        metavar="BYTES",
        help="begin another file when one is so large",
    )
    parser.add_argument(
        "-d",
        "--max-bag-duration",
        type=seconds,
        default=0.0,
        metavar="SECONDS",
        help="begin another file when one has so much time in it",
    )
    parser.add_argument("--include-hidden-topics", action="store_true", help="hidden ones too")
    parser.add_argument("--no-discovery", action="store_true", help="only topics that are there at the begin")


def _playing(parser: CommandParser) -> None:
    parser.add_argument("bag", metavar="BAG", help="a folder, or an MCAP file")
    parser.add_argument(
        "-r", "--rate", type=positive, default=1.0, metavar="N", help="so many times as quick (default: 1)"
    )
    parser.add_argument("-l", "--loop", action="store_true", help="again and again")
    parser.add_argument(
        "--start-offset", type=seconds, default=0.0, metavar="SECONDS", help="begin so far into it"
    )
    parser.add_argument(
        "-m",
        "--remap",
        nargs="+",
        default=[],
        metavar="OLD:=NEW",
        help="publish topics under other names",
    )
    parser.add_argument(
        "--clock",
        nargs="?",
        type=positive,
        const=_CLOCK_RATE,
        metavar="HZ",
        help=f"publish the time of the recording on /clock, so often a second ({_CLOCK_RATE:g})",
    )
    parser.add_argument("-d", "--delay", type=seconds, default=0.0, metavar="SECONDS", help="wait first")
    parser.add_argument("-p", "--start-paused", action="store_true", help="wait for the space bar")
    parser.add_argument("--disable-keyboard-controls", action="store_true", help="hear no keys")
    parser.set_defaults(names=[], all=False, include_hidden_topics=True)


_VERBS: Final = {
    "record": Verb("record messages until Ctrl-C", "bag.recording:record", (_recording, _choosing)),
    "info": Verb(
        "show what is in a bag", "bag.information:info", (word("bag", "a folder, or an MCAP file"),)
    ),
    "play": Verb("publish the messages of a bag again", "bag.playing:play", (_playing, _choosing)),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("bag", "Record messages to MCAP and play them again.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("bag", _VERBS[options.verb], options)

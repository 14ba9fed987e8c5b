"""The options of `bag record`, `bag play` and `bag info`, under the names that they have in rosbag2."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.options import natural, positive, seconds

if TYPE_CHECKING:
    from orchestra.cli.parser import CommandParser

_SPIN_TIME: Final = 3.5
_CLOCK_RATE: Final = 40.0
_POLLING: Final = 100
_CACHE: Final = 256 * 2**20
_PRESETS: Final = ("none", "fastwrite", "zstd_fast", "zstd_small")


def choosing(parser: CommandParser) -> None:
    """Add which topics are meant, and with which QoS."""
    lists = {
        "--topics": ("TOPIC", "these topics"),
        "--services": ("SERVICE", "what these services tell of their requests and responses"),
        "--exclude-topics": ("TOPIC", "none of these topics"),
        "--exclude-services": ("SERVICE", "none of these services"),
    }
    for name, (metavar, tell) in lists.items():
        parser.add_argument(name, nargs="+", default=[], metavar=metavar, help=tell)
    parser.add_argument(
        "-e", "--regex", metavar="RE", help="topics and services in which this regular expression is found"
    )
    parser.add_argument("-x", "--exclude-regex", metavar="RE", help="none in which this is found")
    parser.add_argument(
        "--qos-profile-overrides-path", metavar="FILE", help="the QoS of single topics, in YAML"
    )
    parser.add_argument("-s", "--storage", choices=["mcap"], default="mcap", help="there is no other")
    parser.add_argument("--disable-keyboard-controls", action="store_true", help="hear no keys")
    _nothing(parser, "--log-level", "LEVEL", "nothing is logged")
    # These commands take no time from /clock.
    parser.set_defaults(use_sim_time=False, spin_time=_SPIN_TIME)


def recording(parser: CommandParser) -> None:
    """Add what only a recorder has."""
    parser.add_argument("names", nargs="*", metavar="TOPIC", help="the topics to record")
    _kinds(parser)
    parser.add_argument("-o", "--output", metavar="FOLDER", help="where to (default: rosbag2_ and the time)")
    parser.add_argument("--duration", type=positive, metavar="SECONDS", help="end after this time")
    parser.add_argument(
        "--use-sim-time",
        action="store_true",
        dest="clock_time",
        help="give messages the time of /clock, and record nothing before that is there",
    )
    parser.add_argument("--start-paused", action="store_true", help="wait for the space bar")
    parser.add_argument("--node-name", metavar="NAME", help="the name of the node that records")
    parser.add_argument(
        "--custom-data", nargs="*", default=[], metavar="KEY=VALUE", help="what the bag says besides"
    )
    _finding(parser)
    _storing(parser)


def playing(parser: CommandParser) -> None:
    """Add what only a player has."""
    parser.add_argument("bag", metavar="BAG", help="a folder, or an MCAP file")
    parser.add_argument(
        "-r", "--rate", type=positive, default=1.0, metavar="N", help="so many times as quick (default: 1)"
    )
    parser.add_argument("-l", "--loop", action="store_true", help="again and again")
    parser.add_argument(
        "--start-offset", type=seconds, default=0.0, metavar="SECONDS", help="begin so far into it"
    )
    _ends(parser)
    parser.add_argument(
        *("-m", "--remap"),
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
    parser.add_argument(
        "--wait-for-all-acked",
        type=natural,
        default=1000,
        metavar="MS",
        help="stay so long at the end until all has arrived, 0: without end (default: 1000)",
    )
    _nothing(parser, "--read-ahead-queue-size", "N", "20,000 messages are read ahead")
    _nothing(parser, "--storage-config-file", "FILE", "there is nothing to set for reading")
    parser.add_argument("--disable-loan-message", action="store_true", help="nothing: none are loaned")
    parser.set_defaults(
        names=[],
        topic_types=[],
        exclude_topic_types=[],
        all=False,
        all_topics=False,
        all_services=False,
        include_hidden_topics=True,
    )


def telling(parser: CommandParser) -> None:
    """Add the options of `bag info`."""
    parser.add_argument("bag", metavar="BAG", help="a folder, or an MCAP file")
    parser.add_argument("-t", "--topic-name", action="store_true", help="only the names of the topics")
    parser.add_argument(
        "-v", "--verbose", action="store_true", help="requests and responses of services by themselves"
    )
    storage(parser)


def storage(parser: CommandParser) -> None:
    """Add how a bag is stored."""
    parser.add_argument("-s", "--storage", choices=["mcap"], default="mcap", help="there is no other")


def _kinds(parser: CommandParser) -> None:
    parser.add_argument("-a", "--all", action="store_true", help="all topics and services")
    parser.add_argument("--all-topics", action="store_true", help="all topics")
    parser.add_argument("--all-services", action="store_true", help="all services")
    parser.add_argument("--topic-types", nargs="+", default=[], metavar="TYPE", help="topics of these types")
    parser.add_argument(
        "--exclude-topic-types", nargs="+", default=[], metavar="TYPE", help="none of these types"
    )


def _finding(parser: CommandParser) -> None:
    """Add how topics are found."""
    parser.add_argument("--include-hidden-topics", action="store_true", help="hidden ones too")
    parser.add_argument(
        "--include-unpublished-topics", action="store_true", help="also topics that are only heard"
    )
    parser.add_argument("--ignore-leaf-topics", action="store_true", help="only topics that somebody hears")
    parser.add_argument("--no-discovery", action="store_true", help="only topics that are there at the begin")
    parser.add_argument(
        *("-p", "--polling-interval"),
        type=natural,
        default=_POLLING,
        metavar="MS",
        help=f"look for new topics so often (default: {_POLLING})",
    )


def _storing(parser: CommandParser) -> None:
    """Add how files are written."""
    sizes = {
        ("-b", "--max-bag-size"): (natural, 0, "BYTES", "begin another file when one is so large"),
        ("-d", "--max-bag-duration"): (
            seconds,
            0.0,
            "SECONDS",
            "begin another file when one has so much time in it",
        ),
        ("--max-cache-size",): (
            natural,
            _CACHE,
            "BYTES",
            f"so much may wait for the disk (default: {_CACHE})",
        ),
    }
    for names, (kind, default, metavar, tell) in sizes.items():
        parser.add_argument(*names, type=kind, default=default, metavar=metavar, help=tell)
    parser.add_argument(
        "--storage-preset-profile", choices=_PRESETS, default="none", help="how MCAP is written"
    )
    parser.add_argument("--storage-config-file", metavar="FILE", help="how MCAP is written, in YAML")
    parser.add_argument(
        "--compression", choices=["none", "lz4", "zstd"], help="of the chunks of the file (default: none)"
    )
    parser.add_argument(
        "--compression-mode",
        choices=["none", "file", "message"],
        default="none",
        help="of whole files, or of messages, for tools that cannot read compressed chunks",
    )
    parser.add_argument("--compression-format", choices=["zstd"], default="", help="for --compression-mode")
    for name in ("queue-size", "threads", "threads-priority"):
        _nothing(parser, f"--compression-{name}", "N", "one thread writes")
    parser.add_argument(
        "-f", "--serialization-format", choices=["cdr"], default="cdr", help="there is no other"
    )


def _ends(parser: CommandParser) -> None:
    parser.add_argument("--playback-duration", type=seconds, metavar="SECONDS", help="play no more than this")
    parser.add_argument(
        "--playback-until-sec", type=seconds, metavar="SECONDS", help="play until this time of the recording"
    )
    parser.add_argument("--playback-until-nsec", type=natural, metavar="NS", help="the same in nanoseconds")


def _nothing(parser: CommandParser, name: str, metavar: str, why: str) -> None:
    """Take an option of rosbag2 that means nothing here."""
    parser.add_argument(name, metavar=metavar, help=f"nothing: {why}")

"""`orchestra bag`: recording of messages, and playing them again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.cli.ros.asking import answered
from orchestra.cli.ros.bag_options import choosing, playing, recording, storage, telling
from orchestra.cli.ros.options import word
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

_VERBS: Final = {
    "record": Verb("record messages until Ctrl-C", "bag.recording:record", (recording, choosing)),
    "info": Verb("show what is in a bag", "bag.information:info", (telling,)),
    "reindex": Verb(
        "write the metadata of a bag anew",
        "bag.reindexing:reindex",
        (word("bag", "a folder with MCAP files"), storage),
    ),
    "play": Verb("publish the messages of a bag again", "bag.playing:play", (playing, choosing)),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("bag", "Record messages to MCAP and play them again.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    answered("bag", _VERBS[options.verb], options)

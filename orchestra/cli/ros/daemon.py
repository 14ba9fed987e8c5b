"""`orchestra daemon`: there is none. Scripts that end the daemon of the ROS 2 tools and start it again find it so."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Final

from orchestra.cli.boundary import OK
from orchestra.cli.ros.options import flag
from orchestra.cli.ros.verbs import Verb, VerbParser

if TYPE_CHECKING:
    from argparse import Namespace

_WHY: Final = "There is no daemon: each command looks at the graph itself"
_ANSWERS: Final = {"start": _WHY, "status": "The daemon is not running", "stop": "The daemon is not running"}
_VERBS: Final = {
    "start": Verb("nothing: none is needed", "", (flag("-d", "--debug", tell="nothing"),)),
    "status": Verb("tell that none runs", ""),
    "stop": Verb("nothing: none runs", ""),
}


def parser() -> VerbParser:
    """Return what the command understands."""
    return VerbParser("daemon", f"{_WHY}.", _VERBS)


def run(options: Namespace) -> int:
    """Answer."""
    text = f"{_ANSWERS[options.verb]}\n"
    sys.stdout.write(json.dumps({"running": False}) + "\n" if options.format == "json" else text)
    return OK

"""The process of one command: what is asked is the one argument, in JSON; what is answered, standard output."""

from __future__ import annotations

import json
import os
import signal
import sys
from argparse import Namespace
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

# Where this is not installed but run from its sources.
sys.path.append(str(Path(__file__).parents[3]))

if TYPE_CHECKING:
    from types import FrameType

_TERMINATED = 143


def main() -> int:
    """Answer, and return the exit status."""
    from importlib import import_module  # noqa: PLC0415 - after the path is as it should be

    from orchestra.cli.boundary import Telling, guarded  # noqa: PLC0415 - as above
    from orchestra.ros.tools.postponing import postpone  # noqa: PLC0415 - as above

    postpone()
    question = json.loads(sys.argv[1])
    signal.signal(signal.SIGTERM, _leave)
    command: str = question["command"]
    module, _, function = question["tool"].partition(":")

    def answer() -> int:
        tool = import_module(f"orchestra.ros.tools.{module}")
        return int(getattr(tool, function)(Namespace(**question["options"])))

    return guarded(
        answer, Telling(command, "json" if question["options"].get("format") == "json" else "text")
    )


def _leave(_signal: int, _frame: FrameType | None) -> NoReturn:
    raise SystemExit(_TERMINATED)


if __name__ == "__main__":
    try:
        status = main()
    except SystemExit as leaving:
        status = int(leaving.code or 0)
    # Everything is given back; what the interpreter still did would take longer than all the rest of leaving.
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            status = status or 1
    os._exit(status)

"""Runs a document with a supervisor, or a resolver, that is stuck in a call of this file.

stuck.py DOCUMENT supervisor     where a run is about to begin
stuck.py DOCUMENT resolver       where its code decides about a deferred trigger
stuck.py - resolver              where it reads the launch files
"""

from __future__ import annotations

import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, NoReturn

from orchestra.supervise.run import run

if TYPE_CHECKING:
    from orchestra.supervise.resolver.serving import Answer


def stuck_for_ever() -> NoReturn:
    sys.stderr.write("this is stuck\n")
    sys.stderr.flush()
    while True:
        signal.sigwait({signal.SIGUSR1})


def stuck_when_asked(_question: dict[str, Any]) -> NoReturn:
    stuck_for_ever()


def stuck_when_the_run_begins(*_around: object) -> NoReturn:
    stuck_for_ever()


def prepare(stream: BinaryIO) -> int | Answer:
    if sys.argv[1] == "-":
        stuck_for_ever()
    stream.write(Path(sys.argv[1]).read_bytes())
    return stuck_when_asked if sys.argv[2] == "resolver" else 0


sys.exit(run(prepare, stuck_when_the_run_begins if sys.argv[2] == "supervisor" else None))

"""Answers one question: which tool, a function of a module of this room, and the options of the command."""

from __future__ import annotations

import os
import signal
import sys
from argparse import Namespace
from importlib import import_module
from typing import TYPE_CHECKING, Any, NoReturn

from orchestra.cli.boundary import Telling, guarded
from orchestra.ros.tools.postponing import postpone

if TYPE_CHECKING:
    from types import FrameType

_TERMINATED = 143


def answer(question: dict[str, Any]) -> NoReturn:
    """Write the answer to a question, and end this process with the status of the command."""
    try:
        status = _status(question)
    except SystemExit as leaving:
        status = int(leaving.code or 0)
    # Everything is given back; what the interpreter still did would take longer than all the rest of leaving.
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            status = status or 1
    os._exit(status)


def _status(question: dict[str, Any]) -> int:
    postpone()
    _keep_apart()
    signal.signal(signal.SIGTERM, _leave)
    module, _, function = question["tool"].partition(":")

    def act() -> int:
        tool = import_module(f"orchestra.ros.tools.{module}")
        return int(getattr(tool, function)(Namespace(**question["options"])))

    as_json = question["options"].get("format") == "json"
    return guarded(act, Telling(question["command"], "json" if as_json else "text"))


def _keep_apart() -> None:
    """Have what others write on standard output come on standard error, so that the answer is all there is on it.

    Fast DDS writes its own troubles there, as with files of shared memory that a killed process has left.
    """
    stream = sys.stdout
    stream.flush()
    descriptor = os.dup(stream.fileno())
    sys.stdout = open(  # noqa: SIM115, PTH123 - for as long as the process lives
        descriptor, "w", encoding=stream.encoding, errors=stream.errors, buffering=1
    )
    os.dup2(sys.stderr.fileno(), stream.fileno())


def _leave(_signal: int, _frame: FrameType | None) -> NoReturn:
    raise SystemExit(_TERMINATED)

"""What is said about runs that died and left something behind, and what is asked."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from orchestra.cli.boundary import INTERRUPTED, Telling, guarded
from orchestra.cli.runs import folder, told
from orchestra.control import remains
from orchestra.supervise.keeping import remnants as left_behind
from orchestra.supervise.runs import registry

if TYPE_CHECKING:
    from orchestra.supervise.keeping.remnants import Remnant
    from orchestra.supervise.runs.registry import Run

_NAMED = 4
_YES = frozenset({"y", "yes"})


def look_after() -> int:
    """Tell what dead runs have left, and ask at a terminal whether it is to be ended; 130 where the answer is Ctrl-C.

    What has left nothing is tidied up without a word. Nothing that goes wrong here keeps a command from its work.
    """
    status = guarded(_look_after, Telling())
    return status if status == INTERRUPTED else 0


def _look_after() -> int:
    left = left_of(registry.dead(folder()))
    for run, remnants in left:
        if not remnants:
            remains.tidy(run)
        elif not asked(f"warning: {described(run, remnants)}. End them now?"):
            told(f"warning: {described(run, remnants)}; 'orchestra clean' ends them")
        else:
            end(run)
    return 0


def left_of(dead: list[Run]) -> list[tuple[Run, list[Remnant]]]:
    """Return what each of these runs has left; the machine is looked through once."""
    found = left_behind.remnants({run.identity.run for run in dead}) if dead else []
    return [(run, [one for one in found if one.run == run.identity.run]) for run in dead]


def described(run: Run, remnants: list[Remnant]) -> str:
    """Return in words what a run has left."""
    count = len(remnants)
    named = ", ".join(map(str, remnants[:_NAMED])) + (", ..." if count > _NAMED else "")
    return f"run '{run.name}' died and left {count} process{'' if count == 1 else 'es'}: {named}"


def end(run: Run) -> list[Remnant]:
    """End what a run has left and tidy up after it; return what could not be ended, which is told."""
    stuck = left_behind.end({run.identity.run})
    if stuck:
        told(f"error: could not be ended: {', '.join(map(str, stuck))}")
    else:
        remains.tidy(run)
    return stuck


def asked(question: str) -> bool:
    """Ask at the terminal, where somebody sits in front of one; else the answer is no, and nothing is shown."""
    if not _at_the_terminal():
        return False
    sys.stderr.write(f"{question} [y/N] ")
    sys.stderr.flush()
    return sys.stdin.readline().strip().lower() in _YES


def _at_the_terminal() -> bool:
    """Tell whether somebody can answer: a job in the background would be stopped by the question."""
    try:
        return sys.stdin.isatty() and sys.stderr.isatty() and os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except (OSError, ValueError, AttributeError):  # closed, or not ours
        return False

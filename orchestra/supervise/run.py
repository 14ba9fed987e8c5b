"""Where a run begins: this process becomes the keeper, and everything else happens below it.

    keeper       signals and waiting only; owns the terminal
    supervisor   starts, watches and stops the processes of the plan
    resolver     `prepare`: user code and everything heavy lives and dies there

Call it early: what is imported before is imported in all three.
"""

from __future__ import annotations

import os
import signal
import sys
import time

from orchestra.supervise.beginnings import Beginnings
from orchestra.supervise.keeper import keep
from orchestra.supervise.marks import RUN
from orchestra.supervise.resolver import fork_resolver
from orchestra.supervise.signals import disregard_hang_up, receive_signals, reset_signals, stop_signals

TYPE_CHECKING = False  # `typing` itself costs more than the rest of this module
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import BinaryIO


def run(prepare: Callable[[BinaryIO], int]) -> int:
    """Run what `prepare` describes and return the exit status of the design's table.

    `prepare` runs in the resolver process. It writes one JSON document `{"plan": ..., "options": ...}` to the stream
    and returns 0, or tells the user what is wrong and returns another status, which becomes the result.
    """
    keeper = os.getpid()
    return keep(lambda: _supervise(prepare, keeper))


def _supervise(prepare: Callable[[BinaryIO], int], keeper: int) -> int:
    run_id = f"{time.time_ns():x}-{keeper}"
    os.environ[RUN] = run_id
    # The keeper's mask is still in force: no signal can reach the resolver with our handlers, nor us without them.
    resolver = fork_resolver(prepare)
    reset_signals(unblock=False)
    signals = receive_signals((*stop_signals(), signal.SIGCHLD))
    disregard_hang_up()
    signal.pthread_sigmask(signal.SIG_SETMASK, ())
    try:
        # Imported while the resolver works, so that neither waits for the other.
        from orchestra.supervise.boundary import guarded_run  # noqa: PLC0415
    except BaseException:  # noqa: BLE001 - a forked child must not run on into its parent's code
        sys.excepthook(*sys.exc_info())
        return 3
    return guarded_run(Beginnings(run_id, keeper, resolver, signals))

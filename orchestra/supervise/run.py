"""Where a run begins: this process becomes the keeper, and everything else happens below it.

    keeper       signals and waiting only; owns the terminal
    supervisor   starts, watches and stops the processes of the plan
    resolver     `prepare`: user code and everything heavy lives and dies there

Call it early: what is imported before is imported in all three.
"""

from __future__ import annotations

import os
import sys
import time

from orchestra.supervise.beginnings import Beginnings, Kept
from orchestra.supervise.keeping import kernel
from orchestra.supervise.keeping.keeper import keep, no_room
from orchestra.supervise.keeping.marks import RUN, number_of, run_mark
from orchestra.supervise.keeping.patience import Patience
from orchestra.supervise.keeping.signals import (
    disregard_hang_up,
    receive_signals,
    received_signals,
    reset_signals,
    unblock_signals,
)
from orchestra.supervise.keeping.stacks import Stacks
from orchestra.supervise.keeping.standard_streams import fill_standard_descriptors
from orchestra.supervise.resolver.process import fork_resolver
from orchestra.supervise.summons import taken

TYPE_CHECKING = False  # `typing` itself costs more than the rest of this module
if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.supervise.attendance import Attend
    from orchestra.supervise.resolver.process import Prepare
    from orchestra.supervise.warm.launching import Launched


def run(
    prepare: Prepare,
    attend: Attend | None = None,
    afterwards: Callable[[str], None] | None = None,
    foresee: Callable[[], bool] | None = None,
) -> int:
    """Run what `prepare` describes and return the exit status of the design's table.

    `prepare` runs in the resolver process. It writes one JSON document `{"plan": ..., "options": ...}` to the stream
    (`orchestra.supervise.resolver.document.dumps`) and returns 0, or tells the user what is wrong and returns another
    status, which becomes the result.

    A plan with deferred triggers needs code of the description at run time. `prepare` then returns, instead of 0, a
    function that answers questions: it is called in the resolver process, one question at a time, until the run is
    over. Question and answer are JSON data:

        {"ref": N, "event": {"event": NAME, ...}}
            `ref` of the `DeferredAction`; NAME as in `TriggerEvent`. Of a process: `process` (id), `pid`; of its end
            `returncode` (negative for a signal) and `reason` (why it never ran, or null); of its output `stream` and
            `text` (base64); of a state change `transition`, `start_state`, `goal_state`; of the shutdown `reason`,
            `due_to_sigint`.
        {"processes": [...], "components": [...], "triggers": [...], "do": [...], "problems": [...]}
            a fragment of a plan: records as `orchestra.plan.codec.encode` makes them; each list may be left out. Ids
            are new, `do` is carried out in place of the deferred action.
        {"failure": TEXT, "location": LOCATION or null}
            the trigger fails. So it does where the function raises.

    `attend` is called in the supervisor process when the run is about to begin, and may import what it needs then.
    `afterwards` is called in the keeper with the run's mark when everything is over, whoever was killed before.
    `foresee` tells in the supervisor, before there is a plan, whether nodes in Python are likely.
    """
    fill_standard_descriptors()
    kept = Kept(os.getpid(), run_mark(time.time_ns(), os.getpid()), Patience(), Stacks())

    def bury() -> None:
        from orchestra.supervise.keeping import remnants  # noqa: PLC0415 - only where keeper and supervisor were killed

        remnants.end({kept.run_id})
        if afterwards:
            afterwards(kept.run_id)

    status = keep(lambda: _supervise(prepare, attend, kept, foresee), kept.patience, kept.stacks, bury)
    if afterwards:
        afterwards(kept.run_id)
    return status


def _supervise(
    prepare: Prepare,
    attend: Attend | None,
    kept: Kept,
    foresee: Callable[[], bool] | None,
) -> int:
    os.environ[RUN] = kept.run_id
    kernel.set_lock_limit(number_of(kept.run_id) or 0)
    summons = taken(os.environ, kept.keeper)
    # The keeper's mask is still in force: no signal can reach the resolver with our handlers, nor us without them.
    # Until the first processes begin all that is made stays: to walk through it takes time.
    import gc  # noqa: PLC0415 - the keeper has no use for it

    gc.disable()
    try:
        resolver = fork_resolver(prepare, kept.stacks)
    except OSError as error:
        return no_room(error)
    reset_signals(unblock=False)
    signals = receive_signals(received_signals())
    kept.stacks.show_on_request(chain=True)
    disregard_hang_up()
    unblock_signals()
    try:
        ahead = _fork_server(kept.run_id) if foresee and foresee() else None
        # Imported while the resolver works, so that neither waits for the other.
        from orchestra.supervise.boundary import guarded_run  # noqa: PLC0415
    except BaseException:  # noqa: BLE001 - a forked child must not run on into its parent's code
        sys.excepthook(*sys.exc_info())
        return 3
    return guarded_run(Beginnings(kept, resolver, signals, attend, summons, ahead))


def _fork_server(run_id: str) -> Launched | None:
    """Start the fork server before anything else, where it is likely to be needed."""
    # Here, because not every run has nodes in Python; what is imported is needed by all that follows.
    from orchestra.supervise.host import this_host  # noqa: PLC0415
    from orchestra.supervise.process import open_files  # noqa: PLC0415
    from orchestra.supervise.warm.launching import environment_of, launch  # noqa: PLC0415

    open_files.keep_to_ourselves()
    try:
        # The libraries are the same as those of nodes; the folder that has them is made when there is a plan.
        return launch(environment_of(run_id, this_host()))
    except OSError:
        return None  # it is tried again when it is needed, and then told

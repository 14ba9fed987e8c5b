"""The stages of a run, in the supervisor: collect the plan, furnish the directory, run, clear up, tell the outcome."""

from __future__ import annotations

import gc
import os
import signal
from contextlib import ExitStack
from functools import partial
from typing import TYPE_CHECKING

from orchestra.fields import replace
from orchestra.supervise.keeping.attention import Attention
from orchestra.supervise.keeping.dump import Dump
from orchestra.supervise.keeping.kin import Kin, send_to_groups
from orchestra.supervise.keeping.standard_streams import say
from orchestra.supervise.limits.confines import Confines
from orchestra.supervise.loop import Loop
from orchestra.supervise.outcome import FAILED, MISTAKE, UNSTOPPABLE, judge
from orchestra.supervise.resolver.resolving import Collection, Refused
from orchestra.supervise.runs import directory
from orchestra.supervise.runs.furnishing import furnish
from orchestra.supervise.runs.identity import identity
from orchestra.supervise.service_manager import ServiceManager
from orchestra.supervise.setting import Before, surroundings
from orchestra.supervise.system import System
from orchestra.supervise.warm.starts import Starts

if TYPE_CHECKING:
    from orchestra.plan.model import Plan
    from orchestra.supervise.beginnings import Beginnings
    from orchestra.supervise.outcome import Outcome
    from orchestra.supervise.resolver.document import Document
    from orchestra.supervise.resolver.process import Resolver
    from orchestra.supervise.runs.directory import RunDirectory
    from orchestra.supervise.surroundings import Surroundings

# They are asked, and killed after a second; in seconds.
_TOOLS_LEAVE_WITHIN = 1.5


def conduct(beginnings: Beginnings) -> int:
    """Carry out a run and return its exit status. Raises `Refused` where there is nothing to run."""
    loop = Loop()
    attention = Attention(loop, beginnings.signals, lambda _number: None)
    service = ServiceManager(loop, beginnings.summons, say)
    service.reading()
    dump = Dump(loop, beginnings.stacks, say)
    attention.on_dump = dump.take
    kin = Kin(beginnings.run_id)
    starts = Starts(loop, kin, beginnings.run_id, say, beginnings.ahead)
    document, resolver = _collect(loop, beginnings.resolver, attention, dump, starts)
    confines = Confines(loop, beginnings.run_id)
    unfit = confines.take_up(document.plan)
    starts.wanted = document.options.warm
    starts.prepare(document.plan.processes)
    if unfit:
        raise Refused(MISTAKE, unfit)
    runs = directory.state_folder() / "runs"
    try:
        wanted = identity(beginnings.run_id, document.options.name, document.plan.file, beginnings.keeper)
        run_directory = directory.create(runs, wanted, exact=document.options.named)
        if document.options.files is not None:
            run_directory.adopt(document.options.files)
        plan = _furnish(document, run_directory)
    except directory.NameTakenError as error:
        raise Refused(MISTAKE, str(error)) from error
    except OSError as error:
        raise Refused(FAILED, f"the run directory cannot be written: {error}") from error
    with surroundings(
        loop,
        run_directory,
        plan,
        replace(document.options, name=run_directory.name),
        beginnings=beginnings,
        resolver=resolver,
        before=Before(kin, confines, service, starts),
    ) as around:
        dump.say, dump.folder, dump.resolver = around.journal.say, around.folder, lambda: around.questions.pid
        outcome = _run(beginnings, attention, dump, plan, around)
    try:
        run_directory.release(settled=outcome.status != UNSTOPPABLE)
        directory.prune(runs)
    except OSError as error:
        say(f"the runs could not be tidied up: {error}")
    return outcome.status


def _collect(
    loop: Loop, resolver: Resolver, attention: Attention, dump: Dump, starts: Starts
) -> tuple[Document, Resolver | None]:
    """Wait for the plan, and for the end of the resolver unless it goes on: then it is returned too.

    What the resolver started and left behind ends here: it was not asked for.
    """
    collection = Collection(resolver, loop)
    attention.on_stop = collection.stop_signal
    dump.report, dump.resolver = collection.state_report, lambda: collection.pid
    try:
        while not collection.done:
            loop.run_once()
        document = collection.result()
        if not collection.stays:
            return document, None
        if collection.settled or any(trigger.deferred for trigger in document.plan.triggers):
            collection.hand_on()
            return document, resolver
        collection.dismiss()
        while not collection.done:
            loop.run_once()
        collection.check_ending()
        return document, None
    finally:
        kin = Kin("")
        kin.add(resolver.pid, None)
        if starts.pid is not None:
            kin.add(starts.pid, None)
        kin.refresh()
        send_to_groups([adopted.pid for adopted in kin.of(None)], signal.SIGKILL)


def _furnish(document: Document, run_directory: RunDirectory) -> Plan:
    """Write the plan and the parameter files; return the plan with the run directory filled in."""
    (run_directory.path / "plan.json").write_text(document.text, "utf-8", "surrogatepass")
    return furnish(document.plan, str(run_directory.path))


def _run(
    beginnings: Beginnings, attention: Attention, dump: Dump, plan: Plan, around: Surroundings
) -> Outcome:
    system = System(plan, around)
    dump.report = system.state_report
    attention.on_child = system.child_ended
    attention.on_stop = system.stop_signal
    attention.on_resize = around.console.resize
    attention.on_suspend = around.console.suspend
    attention.on_resume = around.console.resume
    around.recorder.record(
        "run_started",
        pid=os.getpid(),
        run=beginnings.run_id,
        name=around.options.name,
        directory=str(around.folder),
        file=plan.file,
    )
    count = len(plan.processes)
    around.journal.say(f"{count} process{'' if count == 1 else 'es'}; logs in {around.folder / 'logs'}")
    with ExitStack() as attended:
        if beginnings.attend:
            attendant = beginnings.attend(around, system.operation, beginnings.run_id, beginnings.keeper)
            attended.callback(attendant.close)
        system.begin()
        # In the second round: in the first one begins what waits for nothing.
        around.loop.call_later(0.0, partial(around.loop.call_later, 0.0, _collect_garbage))
        while not system.over:
            around.loop.run_once()
        system.finish()
        return _conclude(system, around, beginnings)


def _collect_garbage() -> None:
    """Tidy up memory from now on, without what has come with the begin, which stays."""
    gc.freeze()
    gc.enable()


def _conclude(system: System, around: Surroundings, beginnings: Beginnings) -> Outcome:
    """Look for leftovers, and tell how it all ended: the last line and the last event."""
    # Here, because no first process waits for it.
    from orchestra.supervise.keeping import shared_memory  # noqa: PLC0415
    from orchestra.supervise.keeping.leftovers import end_leftovers  # noqa: PLC0415

    around.observers.leave()
    around.starts.leave()
    around.questions.leave()
    patience = around.loop.call_later(_TOOLS_LEAVE_WITHIN, lambda: None)
    while (
        around.observers.alive or around.questions.alive or around.trials.alive or around.starts.alive
    ) and not patience.cancelled:
        around.loop.run_once()
    left = end_leftovers(around, beginnings.run_id, remaining=system.stopping.remaining)
    if around.kin.dead_readers:
        around.kin.dead_readers.end()
        shared_memory.remove_leftovers(beginnings.began)
    outcome = judge(system.facts(left))
    around.journal.settle()
    if around.journal.lost:
        around.journal.say(f"{around.journal.lost} bytes of logs could not be written")
    if os.getppid() != beginnings.keeper:
        around.journal.say("the keeper was killed")
    around.journal.say(f"run ended with status {outcome.status}: {outcome.reason}")
    around.service.ended(f"ended with status {outcome.status}: {outcome.reason}")
    around.recorder.record("run_ended", status=outcome.status, reason=outcome.reason)
    beginnings.settle(outcome.status)
    return outcome

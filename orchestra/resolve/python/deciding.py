"""Calls the code of a description that was left for the run, and resolves what it decides."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.fields import replace
from orchestra.resolve.occasions import Occasion, OpenEvent
from orchestra.resolve.python.calling import user_code
from orchestra.resolve.python.deferral import copied
from orchestra.resolve.python.emitting import emit
from orchestra.resolve.python.occurrences import observed
from orchestra.resolve.python.visiting import visit_entities, visit_entity
from orchestra.resolve.running import name_in_launch
from orchestra.resolve.settling import cancelled, settled_actions

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.errors import Problems
    from orchestra.resolve.python.deferral import Kept
    from orchestra.resolve.reactions import TriggeredAction
    from orchestra.resolve.resolution import Resolution


def decide(
    ref: int, happened: Mapping[str, Any], index: int | None, run: Resolution, problems: Problems
) -> tuple[TriggeredAction, ...]:
    """Let the code kept under a number decide about what happened to a process; return what is done now.

    What it adds is found in the resolution; what is wrong with it is in `problems`. Code stands in the scope of the
    place where it was written, as it was there: what it sets is forgotten.
    """
    kept: Kept = run.found.kept[ref]
    scope = copied(kept.scope)
    scope.problems = problems
    run.problems, run.scope, run.frames = problems, scope, kept.frames
    run.context = replace(
        kept.context,
        problems=problems,
        variables=scope,
        environment=scope.environment,
        parameters=scope.parameter_texts,
    )
    occasion = Occasion(OpenEvent("run_started"), kept.location, now=True)
    run.occasion = occasion
    event = None if kept.deferred.kind != "handler" else _event(happened, index, run)
    context = run.engine.context
    context._push_locals()
    context.extend_locals({"event": event})
    _carry_out(kept, event, run)
    run.handle_events()
    context._pop_locals()
    run.occasion = None
    return (*settled_actions(occasion, run), *cancelled(run))


def _carry_out(kept: Kept, event: Any, run: Resolution) -> None:
    deferred, span = kept.deferred, kept.location.span
    if deferred.kind == "entity":
        visit_entity(deferred.target, run)
        return
    if deferred.kind == "action":
        run.visit((deferred.target,), run)
        return
    if deferred.kind == "event":
        emit(deferred.target, kept.location, run)
        return
    returned: Any = None
    with user_code(run, span):
        if deferred.target.matches(event):
            returned = deferred.callback(event, run.engine.context)
    if returned is not None:
        visit_entities([returned] if not isinstance(returned, list | tuple) else returned, run)


def _event(happened: Mapping[str, Any], index: int | None, run: Resolution) -> Any:
    process = None if index is None else run.found.processes[index]
    return observed(happened, process, "" if process is None else name_in_launch(process, index or 0))

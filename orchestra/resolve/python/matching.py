"""Which processes a predicate on actions means."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.events.matchers import ActionMatcher
from orchestra.resolve.python.calling import user_code
from orchestra.resolve.running import name_in_launch

if TYPE_CHECKING:
    from orchestra.resolve.model import ResolvedProcess
    from orchestra.resolve.resolution import Resolution


def accepted(predicate: Any, run: Resolution) -> tuple[int, ...]:
    """Return the processes that a predicate means: one of ours by what it looks for, another by calling it."""
    if not isinstance(predicate, ActionMatcher):
        processes = enumerate(tuple(run.found.processes))
        return tuple(index for index, process in processes if _accepts(predicate, process, run))
    if predicate.by == "action":
        return run.found.made_by(predicate.target)
    processes = enumerate(run.found.processes)
    return tuple(index for index, process in processes if _looked_for(predicate, index, process))


def _accepts(predicate: Any, process: ResolvedProcess, run: Resolution) -> bool:
    if process.origin is None:
        return False
    answers: list[Any] = []
    with user_code(run, process.location.span):
        answers.append(predicate(process.origin))
    return any(answers)


def _looked_for(matcher: ActionMatcher, index: int, process: ResolvedProcess) -> bool:
    match matcher.by:
        case "name":
            return bool(matcher.target == name_in_launch(process, index))
        case "executable":
            end: str = matcher.target
            return bool(process.program) and process.program[0].endswith(end)
        case "node_name":
            return bool(_full_name(process) == matcher.target)
        case _:
            return False


def _full_name(process: ResolvedProcess) -> str | None:
    if process.name is None:
        return None
    namespace = process.namespace.text if process.namespace is not None else ""
    return f"{namespace.rstrip('/')}/{process.name.text}"

"""`depends_on` and `ready`, evaluated."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, cast

from orchestra.description.parts import CONDITIONS
from orchestra.errors import Code
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.model import DependencyKind, ResolvedDependency, ResolvedReady

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.parts import DependsOn, Ready
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import Condition


def dependencies(written: Sequence[DependsOn], run: Resolution) -> tuple[ResolvedDependency, ...] | Poison:
    """Return all that is waited for."""
    found = [_dependency(item, run) for item in written]
    sound = tuple(item for item in found if not isinstance(item, Poison))
    return sound if len(sound) == len(found) else POISON


def _dependency(written: DependsOn, run: Resolution) -> ResolvedDependency | Poison:
    targets = {"node": written.node, "process": written.process, "label": written.label}
    kind, template = next((kind, target) for kind, target in targets.items() if target is not None)
    action = template.action
    name = run.evaluate(template) if action is None else Value(template.raw, run.at(template.span))
    timeout = run.number(written.timeout)
    condition = run.word(written.condition, CONDITIONS)
    if not isinstance(name, Value) or isinstance(timeout, Poison) or isinstance(condition, Poison):
        return POISON
    awaited = cast("Condition", condition or "started")
    if action is not None:
        return ResolvedDependency("action", name, awaited, timeout, action)
    return ResolvedDependency(cast("DependencyKind", kind), name, awaited, timeout)


def readiness(written: Ready | None, run: Resolution) -> ResolvedReady | Poison | None:
    """Return when a process counts as ready, None where nothing is said."""
    if written is None:
        return None
    message, log = run.evaluate(written.message), run.evaluate(written.log)
    timeout = run.number(written.timeout)
    if isinstance(message, Poison) or isinstance(log, Poison) or isinstance(timeout, Poison):
        return POISON
    if log is not None:
        try:
            re.compile(log.text)
        except re.error as error:
            run.problems.error(Code.BAD_VALUE, f"this is no regular expression: {error}", log.location)
            return POISON
    return ResolvedReady(message, log, timeout)

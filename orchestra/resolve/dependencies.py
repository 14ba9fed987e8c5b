"""`depends_on` and `ready`, evaluated."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, cast

from orchestra.errors import Code
from orchestra.resolve.context import Poison, Value
from orchestra.resolve.model import DependencyKind, ResolvedDependency, ResolvedReady

if TYPE_CHECKING:
    from orchestra.description.parts import DependsOn, Ready
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import Condition


def dependency(written: DependsOn, run: Resolution) -> ResolvedDependency | None:
    """Return what is waited for, None where that cannot be known (which has been reported)."""
    targets = {"node": written.node, "process": written.process, "label": written.label}
    kind, template = next((kind, target) for kind, target in targets.items() if target is not None)
    name = run.evaluate(template)
    timeout = run.number(written.timeout)
    condition = run.text(written.condition) if written.condition is not None else "started"
    if not isinstance(name, Value) or isinstance(timeout, Poison) or not isinstance(condition, str):
        return None
    return ResolvedDependency(
        cast("DependencyKind", kind), name, cast("Condition", condition), timeout, run.at(written.span)
    )


def readiness(written: Ready, run: Resolution) -> ResolvedReady | None:
    """Return when a process counts as ready, None where that cannot be known (which has been reported)."""
    message, log, timeout = (
        run.evaluate(written.message),
        run.evaluate(written.log),
        run.number(written.timeout),
    )
    if isinstance(message, Poison) or isinstance(log, Poison) or isinstance(timeout, Poison):
        return None
    if log is not None:
        try:
            re.compile(log.text)
        except re.error as error:
            run.problems.error(Code.BAD_VALUE, f"this is no regular expression: {error}", log.location)
            return None
    return ResolvedReady(message, log, timeout)

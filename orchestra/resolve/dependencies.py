"""`depends_on`, evaluated."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from orchestra.description.parts import CONDITIONS
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.model import DependencyKind, ResolvedDependency

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.parts import DependsOn
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
    condition, required = run.word(written.condition, CONDITIONS), run.flag(written.required, default=True)
    if not isinstance(name, Value) or isinstance(timeout, Poison):
        return POISON
    if isinstance(condition, Poison) or isinstance(required, Poison) or written.faulty:
        return POISON
    return ResolvedDependency(
        cast("DependencyKind", kind) if action is None else "action",
        name,
        cast("Condition", condition or "started"),
        timeout,
        required is not False,
        action,
    )

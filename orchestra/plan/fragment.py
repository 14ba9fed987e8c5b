"""What is added to a plan while it runs: the records that come after those which are there."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from orchestra.plan.build import build
from orchestra.plan.codec import encode, encode_problem
from orchestra.plan.triggers import actions
from orchestra.plan.warm import warmed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.errors import Problems
    from orchestra.plan.model import Plan
    from orchestra.resolve.model import Resolved
    from orchestra.resolve.reactions import TriggeredAction


def fragment(
    before: Plan, resolved: Resolved, do: Sequence[TriggeredAction], problems: Problems, *, triggers: int
) -> tuple[Plan, dict[str, Any]]:
    """Return the plan as it is then, and as JSON data what is new in it and done at once.

    `resolved` has everything; its triggers are the new ones alone, before which there were `triggers` in all.
    """
    named = {process.id for process in before.processes} | {component.id for component in before.components}
    known = named | {trigger.id for trigger in before.triggers}
    after = warmed(build(resolved, problems, triggers_before=triggers, known=named), os.environ)
    new = {
        "processes": [record for record in after.processes if record.id not in known],
        "components": [record for record in after.components if record.id not in known],
        "triggers": [record for record in after.triggers if record.id not in known],
        "do": actions(do, after),
    }
    told = {problem for problem in problems if problem not in before.problems}
    return after, {
        **encode(new),
        "problems": [encode_problem(problem) for problem in problems if problem in told],
    }

"""The table of checks. Each looks at what was resolved and planned as a whole, and reports."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Protocol

from orchestra.plan.checks.cores import check_cores
from orchestra.plan.checks.declared import check_declared
from orchestra.plan.checks.doubled import check_doubled
from orchestra.plan.checks.interfaces import check_interfaces
from orchestra.plan.checks.nameless import check_nameless
from orchestra.plan.checks.sections import check_sections
from orchestra.plan.checks.topics import check_topics
from orchestra.plan.checks.waits import check_waits

if TYPE_CHECKING:
    from orchestra.errors import Problems
    from orchestra.plan.model import Plan
    from orchestra.resolve.model import Resolved


class Check(Protocol):
    """Finds one kind of mistake. What is `faulty`, `lost` or follows from a reported problem is left alone."""

    def __call__(self, resolved: Resolved, plan: Plan, problems: Problems, /) -> None:
        """Report what is wrong."""


CHECKS: Final[tuple[Check, ...]] = (
    check_declared,
    check_interfaces,
    check_sections,
    check_waits,
    check_doubled,
    check_topics,
    check_cores,
    check_nameless,
)


def check_all(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Let every check look at a plan."""
    for check in CHECKS:
        check(resolved, plan, problems)

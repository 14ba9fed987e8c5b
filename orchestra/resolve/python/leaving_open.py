"""Errors of Python launch files that come of an unset environment variable alone, where nothing will be started."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.unset_values import left_open
from orchestra.errors import Severity
from orchestra.resolve.refusals import unset_environment

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.errors import Problems


def leave_open(problems: Problems, environment: Mapping[str, str], weight: Severity) -> None:
    """Name the variable for each, which weighs so much; what is nearly the name of one that is set stays an error."""

    def told(name: str) -> str | None:
        unset = None if name in environment else unset_environment(name, environment, weight)
        return None if unset is None or unset.severity is Severity.ERROR else unset.told

    problems.amend(lambda problem: left_open(problem, told, weight))

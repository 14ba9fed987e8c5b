"""How tests say which rows of the launch language they hold to.

`@pytest.mark.conforms("1.4 FindExecutable", ...)` marks a test with rows; in a table of cases each case names its row.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from _pytest.mark import ParameterSet


def row_of(case: str) -> str:
    """Return the row of a case that is called `ROW` or `ROW, what of it`."""
    return case.partition(", ")[0]


def conforming(cases: Iterable[str], row: Callable[[str], str] = row_of) -> list[ParameterSet]:
    """Return the names of cases as parameters, each marked with its row."""
    return [pytest.param(case, id=case, marks=pytest.mark.conforms(row(case))) for case in cases]


def marked(identity: str, *values: Any) -> ParameterSet:
    """Return the values of a case, marked with its row."""
    return pytest.param(*values, marks=pytest.mark.conforms(row_of(identity)))

"""Explanations of the values of a node, as frozen data."""

from __future__ import annotations

from typing import Any, Literal, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.plan.model import Candidate

Subject: TypeAlias = Literal["name", "namespace", "parameter", "remapping", "environment"]


@dataclass(frozen=True, slots=True)
class Explained:
    """One value: what it is of, what it comes to, and all candidates in order. `note` is said besides.

    The candidates of a remapping are the rules, `FROM:=TO`, and its value is the name that comes of it.
    """

    subject: Subject
    name: str
    value: Any
    candidates: tuple[Candidate, ...]
    note: str | None = None


@dataclass(frozen=True, slots=True)
class Explanation:
    """What is explained of one process or component; `kind` is that of the process, or `component`."""

    id: str
    kind: str
    location: Location
    values: tuple[Explained, ...]

"""A launch description: the actions of one file."""

from __future__ import annotations

from dataclasses import dataclass

from orchestra.description.entity import Action


@dataclass(frozen=True, slots=True)
class Description:
    """What one launch file says.

    `path` is the absolute path. `incomplete` tells that actions with faults have been left out, so that what they
    would have provided is not reported missing.
    """

    path: str
    file: str
    actions: tuple[Action, ...]
    deprecated: str | None = None
    incomplete: bool = False

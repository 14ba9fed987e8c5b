"""A launch description: the actions of one file."""

from __future__ import annotations

from orchestra.dataclass import dataclass
from orchestra.description.entity import Action, Entity
from orchestra.description.fields import Literal
from orchestra.description.model import field
from orchestra.description.nested import Children
from orchestra.description.text import Template
from orchestra.location import Span


class Launch(Entity):
    """What stands below `launch`, where it is more than a list of actions."""

    deprecated: Literal | None = field(default=None, description="Why the file is not to be used any more.")
    children: Children = field(description="The actions.")


@dataclass(frozen=True, slots=True)
class Description:
    """What one launch file says.

    `path` is the absolute path. `deprecated` says why the file is not to be used any more. `lost` has every scalar of
    the actions that have been left out for their faults: what they would have provided is not reported missing.
    `foreign` tells that the file may have variables in it as other languages write them. `doubted` are the ranges that
    have been read as they were probably meant: what is found there may follow from that.
    """

    path: str
    file: str
    actions: tuple[Action, ...]
    deprecated: Template | None = None
    lost: frozenset[str] = frozenset()
    foreign: bool = False
    doubted: tuple[Span, ...] = ()

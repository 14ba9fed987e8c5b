"""What a running node has told: its parameters by their descriptors, its interfaces by the graph."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from orchestra.dataclass import dataclass
from orchestra.declared.common import is_common
from orchestra.fields import field


@dataclass(frozen=True, slots=True)
class CapturedParameter:
    """A parameter; `type` is a word of `orchestra.declared.model.RosType`, None where it has none.

    `range` is least and greatest value and the step between them, 0 for none.
    """

    name: str
    type: str | None
    value: Any
    description: str = ""
    additional_constraints: str = ""
    read_only: bool = False
    dynamic_typing: bool = False
    range: tuple[float, float, float] | None = None


@dataclass(frozen=True, slots=True)
class Captured:
    """A node: its parameters, without those that every node has, and its interfaces by kind where they are wanted."""

    node: str
    parameters: tuple[CapturedParameter, ...]
    interfaces: Mapping[str, list[dict[str, Any]]] = field(default_factory=dict)


def captured(node: str, answer: Mapping[str, Any]) -> Captured:
    """Return what `orchestra.ros.capture` has answered."""
    parameters = tuple(
        CapturedParameter(**{**item, "range": None if item["range"] is None else tuple(item["range"])})
        for item in answer["parameters"]
        if not is_common(item["name"])
    )
    return Captured(node, parameters, answer.get("interfaces", {}))

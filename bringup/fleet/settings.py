"""The monitor's parameters: values, bounds, descriptions."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator


@dataclass(frozen=True, slots=True)
class Setting:
    """How one parameter is described: its default, its range (both ends allowed), its meaning."""

    name: str
    default: float | str
    description: str
    minimum: float | None = None
    maximum: float | None = None
    fixed: bool = False


def _number(default: float, low: float, high: float, description: str) -> Any:  # noqa: ANN401 - fields are
    return field(default=default, metadata={"minimum": low, "maximum": high, "description": description})


def _name(default: str, description: str) -> Any:  # noqa: ANN401 - fields are
    return field(default=default, metadata={"description": description, "fixed": True})


@dataclass(frozen=True, slots=True)
class Settings:
    """Values of all parameters at one moment; field names are parameter names."""

    rate: float = _number(2.0, 0.1, 20.0, "Summaries per second of the machine's time")
    stale_after: float = _number(1.0, 0.05, 60.0, "Age in s of ROS time from which on odometry is too old")
    gone_after: float = _number(
        3.0,
        0.0,
        600.0,
        "Seconds without anything in the graph after which a robot has gone, and its claim with it",
    )
    claim_distance: float = _number(0.8, 0.0, 100.0, "Least distance in m between the goals of two robots")
    odometry: str = _name("odometry/filtered", "Topic, in a robot's namespace, that makes it one")
    controller: str = _name(
        "velocity_controller", "Node, in a robot's namespace, that drives it; empty: any will do"
    )


def table() -> Iterator[Setting]:
    """Every parameter as it is declared, in the order of `Settings`."""
    for each in fields(Settings):
        if isinstance(each.default, float | str):
            yield Setting(name=each.name, default=each.default, **each.metadata)

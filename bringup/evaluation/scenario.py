"""What a run in lockstep is made with: the parameter files of the bringup, and what is to be different from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from difflib import get_close_matches
from pathlib import Path
from typing import Any

import yaml

from bringup.control.settings import Settings as ControlSettings
from bringup.control.settings import objection
from bringup.world.settings import TABLE, checked, settings
from bringup.world.settings import Settings as WorldSettings
from bringup.world.table import BY_NAME

PARAMETERS = Path(__file__).parent.parent / "params"


@dataclass(frozen=True, slots=True)
class Scenario:
    """One run: a world with its robots and their errors, the parameters of all filters and of all controllers."""

    world: WorldSettings
    filter: Mapping[str, object]
    control: ControlSettings
    seconds: float


@dataclass(frozen=True, slots=True)
class Choice:
    """What is chosen for all runs: their length, the parameter files, and changes to single parameters of the three."""

    seconds: float
    folder: Path = PARAMETERS
    simulation: Mapping[str, object] = field(default_factory=dict)
    filter: Mapping[str, object] = field(default_factory=dict)
    control: Mapping[str, object] = field(default_factory=dict)


def scenario(choice: Choice, **changes: object) -> Scenario:
    """The bringup's own parameters but for what is chosen, and for `changes` to those of the simulation.

    Raises OSError or KeyError for a folder without the three files, ValueError for what cannot be used.
    """
    folder = choice.folder
    defaults = {setting.name: setting.default for setting in TABLE}
    simulation = {**given(folder, "simulation"), **choice.simulation, **changes}
    _require_known("simulation", simulation, defaults)
    for name, value in simulation.items():
        if isinstance(defaults[name], int | float) and not isinstance(defaults[name], bool):
            simulation[name] = checked(BY_NAME[name], value)
    return Scenario(
        world=settings({**defaults, **simulation}),
        filter={**given(folder, "ekf"), **choice.filter},
        control=_control({**given(folder, "velocity_controller"), "mode": "wander", **choice.control}),
        seconds=choice.seconds,
    )


def _control(values: Mapping[str, Any]) -> ControlSettings:
    _require_known(
        "velocity_controller", values, {each.name: each.default for each in fields(ControlSettings)}
    )
    made = ControlSettings(**values)
    reason = objection(made)
    if reason is not None:
        raise ValueError(f"velocity_controller: {reason}")
    return made


def _require_known(node: str, values: Mapping[str, object], known: Mapping[str, object]) -> None:
    for name in values:
        if name not in known:
            near = get_close_matches(name, known, n=1)
            meant = f"; did you mean {near[0]}?" if near else ""
            raise ValueError(f"{node}: parameter {name} is unknown{meant}")


def given(folder: Path, node: str) -> dict[str, Any]:
    """What the parameter file of a node in a folder says for it."""
    content = yaml.safe_load((folder / f"{node}.yaml").read_text(encoding="utf-8"))
    parameters: dict[str, Any] = content[f"/**/{node}"]["ros__parameters"]
    return parameters

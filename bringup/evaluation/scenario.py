"""What a run in lockstep is made with: the parameter files of the bringup, and what is to be different from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import yaml

from bringup.control.settings import Settings as ControlSettings
from bringup.world.settings import TABLE, settings
from bringup.world.settings import Settings as WorldSettings

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
    control: dict[str, Any] = {**given(folder, "velocity_controller"), "mode": "wander", **choice.control}
    defaults = {setting.name: setting.default for setting in TABLE}
    return Scenario(
        world=settings({**defaults, **given(folder, "simulation"), **choice.simulation, **changes}),
        filter={**given(folder, "ekf"), **choice.filter},
        control=ControlSettings(**control),
        seconds=choice.seconds,
    )


def given(folder: Path, node: str) -> dict[str, Any]:
    """What the parameter file of a node in a folder says for it."""
    content = yaml.safe_load((folder / f"{node}.yaml").read_text(encoding="utf-8"))
    parameters: dict[str, Any] = content[f"/**/{node}"]["ros__parameters"]
    return parameters

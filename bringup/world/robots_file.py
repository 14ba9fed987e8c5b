"""A file that lists the robots of a run, with start poses and settings of their own.

    robots:
      robot1: {x: 0.0, y: 0.0, yaw: 1.57}
      robot2: {wheel_slip: 0.02, mode: wander}    # starts where the world has room; `mode` is for others

The launch files read the same file, so that keys that mean nothing here are left to them; one that nearly is a
setting's name is refused.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import yaml

from bringup.world.geometry import Pose
from bringup.world.settings import Robot, SettingsError, checked, nearest
from bringup.world.table import BY_NAME

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

POSE_KEYS = ("x", "y", "yaw")


def read(path: Path) -> tuple[Robot, ...]:
    """The robots of a file, in its order. Raises SettingsError: it cannot be read, or does not say what it should."""
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError) as error:
        raise SettingsError(f"the file of robots cannot be read: {error}") from error
    except yaml.YAMLError as error:
        raise SettingsError(f"the file of robots is no YAML: {' '.join(str(error).split())}") from error
    listed = content.get("robots") if isinstance(content, dict) else None
    if not isinstance(listed, dict) or not listed:
        raise SettingsError(f"{path} names no robots: it should have 'robots:' with one key for each")
    return tuple(_robot(path, str(name), values or {}) for name, values in listed.items())


def _robot(path: Path, name: str, values: Any) -> Robot:  # noqa: ANN401 - whatever YAML gives
    if not isinstance(values, dict):
        raise SettingsError(f"{path}: '{name}' should have settings: {values!r}")
    try:
        return Robot(name, _pose(values), _own(values))
    except SettingsError as error:
        raise SettingsError(f"{path}: {name}: {error}") from error


def _pose(values: Mapping[str, Any]) -> Pose | None:
    given = {key: values[key] for key in POSE_KEYS if key in values}
    if not given:
        return None
    for key, value in given.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
            raise SettingsError(f"'{key}' is no number: {value!r}")
    if not {"x", "y"} <= given.keys():
        raise SettingsError("a start pose needs x and y")
    return Pose(float(given["x"]), float(given["y"]), float(given.get("yaw", 0.0)))


def _own(values: Mapping[str, Any]) -> dict[str, Any]:
    own = {}
    for name, value in values.items():
        setting = BY_NAME.get(str(name))
        if setting is not None and setting.each:
            own[setting.name] = checked(setting, value)
        elif name not in POSE_KEYS and (meant := nearest(str(name), each=True)):
            raise SettingsError(f"'{name}' is no setting; '{meant}' is")
    return own

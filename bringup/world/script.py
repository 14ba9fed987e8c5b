"""A file of commands by simulated time, which drives robots without any controller, the same way each time.

    time,robot,linear,angular
    0.0,robot1,0.4,0.0
    2.5,robot1,0.4,0.8

A command holds from the first tick that is not before its time until the robot's next one; a robot that the file never
names listens to its topic.
"""

from __future__ import annotations

import csv
import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from bringup.world.drive import STILL, Twist
from bringup.world.model import TICKS_PER_SECOND

if TYPE_CHECKING:
    from pathlib import Path

HEADER = ["time", "robot", "linear", "angular"]
# Of a tick: a time that is written with few digits means the tick that it is nearly.
SLACK = 1e-6


class ScriptError(ValueError):
    """A script that cannot be meant; the message says where and why."""


@dataclass(frozen=True, slots=True)
class Script:
    """For each robot the ticks at which a command begins, in order, and the commands."""

    lines: Mapping[str, tuple[Sequence[int], Sequence[Twist]]]

    def command(self, robot: str, tick: int) -> Twist | None:
        """What the robot obeys at a tick; None for a robot that is not in the script."""
        if robot not in self.lines:
            return None
        ticks, commands = self.lines[robot]
        place = bisect_right(ticks, tick)
        return commands[place - 1] if place else STILL


def read_script(path: Path, robots: Sequence[str]) -> Script:
    """Read a script. Raises ScriptError."""
    found: dict[str, dict[int, Twist]] = {}
    try:
        with path.open(encoding="utf-8", newline="") as file:
            rows = list(csv.reader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ScriptError(f"the script cannot be read: {error}") from error
    if not rows or [name.strip() for name in rows[0]] != HEADER:
        raise ScriptError(f"{path}:1: the first line should be {','.join(HEADER)}")
    for number, row in enumerate(rows[1:], start=2):
        if row:
            try:
                robot, tick, command = _line(row, robots)
            except ScriptError as error:
                raise ScriptError(f"{path}:{number}: {error}") from error
            found.setdefault(robot, {})[tick] = command
    ordered = {robot: sorted(lines.items()) for robot, lines in found.items()}
    return Script(
        {
            robot: ([tick for tick, _ in lines], [command for _, command in lines])
            for robot, lines in ordered.items()
        }
    )


def _line(row: Sequence[str], robots: Sequence[str]) -> tuple[str, int, Twist]:
    if len(row) != len(HEADER):
        raise ScriptError(f"{len(row)} columns instead of {len(HEADER)}")
    robot = row[1].strip()
    if robot not in robots:
        raise ScriptError(f"no robot is called '{robot}'; there are {', '.join(robots)}")
    try:
        time, linear, angular = (float(row[place]) for place in (0, 2, 3))
    except ValueError as error:
        raise ScriptError(str(error)) from error
    if not all(map(math.isfinite, (time, linear, angular))) or time < 0.0:
        raise ScriptError(f"not a time and a velocity: {','.join(row)}")
    return robot, math.ceil(time * TICKS_PER_SECOND - SLACK), Twist(linear, angular)

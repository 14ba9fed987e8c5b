"""The course of the world: tick by tick, from velocity commands to motion and contacts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import mujoco

from bringup.world.contacts import ContactCount, touching_robots
from bringup.world.drive import STILL, Limits, Twist, limited, ramped, wheel_speeds
from bringup.world.model import STEPS_PER_TICK, TICKS_PER_SECOND, Model

if TYPE_CHECKING:
    from collections.abc import Sequence

TICK = 1.0 / TICKS_PER_SECOND
COMMAND_TIMEOUT_TICKS = TICKS_PER_SECOND // 2


class Simulation:
    """A model in motion.

    Nothing in it depends on a clock or on chance: the same commands at the same ticks give the same numbers to the
    last bit (with one version of MuJoCo on one kind of processor).
    """

    def __init__(self, model: Model, limits: Limits | None = None) -> None:
        self.model = model
        self.limits = limits or Limits()
        self.data = mujoco.MjData(model.physics)
        mujoco.mj_forward(model.physics, self.data)
        self.ticks = 0
        self.contacts = tuple(ContactCount() for _ in model.robots)
        self._pairs = b""
        self._touching: set[int] = set()
        self._drives = [STILL for _ in model.robots]

    @property
    def time(self) -> float:
        """Simulated seconds since the start."""
        return self.ticks * TICK

    def tick(self, commands: Sequence[Twist]) -> None:
        """Advance by one tick (10 ms); one command per robot, in m/s and rad/s, already timed out where it has to."""
        for number, (robot, command) in enumerate(zip(self.model.robots, commands, strict=True)):
            drive = ramped(self._drives[number], limited(command, self.limits), self.limits, TICK)
            self._drives[number] = drive
            left, right = robot.motors
            self.data.ctrl[left], self.data.ctrl[right] = wheel_speeds(drive)
        for _ in range(STEPS_PER_TICK):
            mujoco.mj_step(self.model.physics, self.data)
            self._count_contacts()
        self.ticks += 1

    def _count_contacts(self) -> None:
        # Every single step counts: a graze can be shorter than a tick. Mostly the same geoms touch as before.
        geoms = self.data.contact.geom
        pairs = geoms.tobytes()
        if pairs != self._pairs:
            self._pairs = pairs
            self._touching = touching_robots(geoms, self.model.owners)
        for number in self._touching:
            self.contacts[number].update(self.data.time, touching=True)


def in_force(command: Twist, age: int) -> Twist:
    """What a command of so many ticks ago still means: after half a second, nothing."""
    return command if age < COMMAND_TIMEOUT_TICKS else STILL

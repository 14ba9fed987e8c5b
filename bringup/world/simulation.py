"""The course of the world: tick by tick, from velocity commands to motion and contacts.

It runs without ROS and without a clock. A run in lockstep, with sensors and all their errors:

    layout = lay_out("maze", seed, ["robot1", "robot2"])
    own = RobotSettings(wheels=WheelErrors(left_scale=1.01), inertial=InertialNoise(gyro_noise=0.005))
    simulation = Simulation(load(layout), own.limits)
    sensors = [Sensors(simulation, number, own, seed) for number in range(2)]
    for _ in range(12_000):                          # 120 s in ticks of 10 ms
        simulation.tick(commands)                    # one Twist per robot
        readings = [each.read() for each in sensors] # `bringup.world.sensing`
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bringup.world.contacts import ContactCount, Touch, touches
from bringup.world.drive import STILL, Limits, Twist, limited, ramped, wheel_speeds
from bringup.world.model import STEPS_PER_TICK, TICKS_PER_SECOND, Model, Moment, moment, place
from bringup.world.physics import mujoco

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bringup.world.geometry import Pose

TICK = 1.0 / TICKS_PER_SECOND
_step = mujoco.mj_step
_NO_SENSORS = int(mujoco.mjtDisableBit.mjDSBL_SENSOR)


class Simulation:
    """A model in motion.

    Nothing in it depends on a clock or on chance: the same commands at the same ticks give the same numbers to the
    last bit (with one version of MuJoCo on one kind of processor). `limits`, one for all robots or one for each, can be
    changed at any time.
    """

    def __init__(self, model: Model, limits: Limits | Sequence[Limits] | None = None) -> None:
        self.model = model
        if limits is None or isinstance(limits, Limits):
            limits = [limits or Limits()] * len(model.robots)
        self.limits = list(limits)
        self.data = mujoco.MjData(model.physics)
        self._motors = self.data.ctrl
        self._moment: Moment | None = None
        self._steady: list[tuple[Twist, Limits] | None] = []
        self.contacts = tuple(ContactCount() for _ in model.robots)
        self.reset()

    @property
    def time(self) -> float:
        """Simulated seconds since the start."""
        return self.ticks * TICK

    def reset(self) -> None:
        """Begin anew: everything is as it was at first, time as well."""
        mujoco.mj_resetData(self.model.physics, self.data)
        for robot in self.model.robots:
            place(self.data, robot, robot.start)
        mujoco.mj_forward(self.model.physics, self.data)
        self.ticks = 0
        for count in self.contacts:
            count.clear()
        self._drives = [STILL for _ in self.model.robots]
        self._forget()

    def teleport(self, number: int, pose: Pose) -> None:
        """Put a robot elsewhere (world coordinates, metres and radians), where it stands still; time does not pass."""
        place(self.data, self.model.robots[number], pose)
        self._drives[number] = STILL
        mujoco.mj_forward(self.model.physics, self.data)
        self._forget()

    def touching(self) -> tuple[Touch, ...]:
        """What touches a robot at this moment, the floor apart."""
        return self._seen.touches

    def moment(self) -> Moment:
        """The numbers of this moment."""
        if self._moment is None:
            self._moment = moment(self.data)
        return self._moment

    def tick(self, commands: Sequence[Twist]) -> None:
        """Advance by one tick (10 ms); one command per robot, in m/s and rad/s, already timed out where it has to."""
        for number, command in zip(range(len(self.limits)), commands, strict=True):
            self._steer(number, command)
        physics, data, options = self.model.physics, self.data, self.model.physics.opt
        # Sensors change nothing in the world, and only those of a tick's last step are ever read.
        flags = options.disableflags
        options.disableflags = flags | _NO_SENSORS
        for step in range(1, STEPS_PER_TICK + 1):
            if step == STEPS_PER_TICK:
                options.disableflags = flags
            _step(physics, data)
            # A graze can be shorter than a tick: whenever the number of contacts changes they are looked at.
            if step == STEPS_PER_TICK or data.ncon != self._seen.count:
                self._look()
            for number in self._seen.robots:
                self.contacts[number].update(data.time, touching=True)
        self.ticks += 1
        self._moment = None

    def _steer(self, number: int, command: Twist) -> None:
        """Let a robot's motors do what becomes of its command."""
        limits = self.limits[number]
        # What the same command has not changed a tick ago it does not change now.
        if self._steady[number] == (command, limits):
            return
        drive = ramped(self._drives[number], limited(command, limits), limits, TICK)
        self._steady[number] = (command, limits) if drive == self._drives[number] else None
        self._drives[number] = drive
        left, right = self.model.robots[number].motors
        self._motors[left], self._motors[right] = wheel_speeds(drive)

    def _forget(self) -> None:
        """Look at everything anew: it is not what the last tick has left."""
        self._seen = _Seen()
        self._moment = None
        self._steady = [None] * len(self.model.robots)

    def _look(self) -> None:
        geoms = self.data.contact.geom
        pairs = geoms.tobytes()
        # Mostly the same geoms touch as before.
        if pairs != self._seen.pairs:
            found = touches(geoms, self.model.owners)
            robots = frozenset(number for touch in found for number in touch.robots)
            self._seen = _Seen(pairs, len(geoms), found, robots)


@dataclass(frozen=True, slots=True)
class _Seen:
    """The contacts of the last look: their geoms as bytes, their number, what is told of them."""

    pairs: bytes = b""
    count: int = -1
    touches: tuple[Touch, ...] = ()
    robots: frozenset[int] = frozenset()


def in_force(command: Twist, age: float, timeout: float) -> Twist:
    """What a command of so many simulated seconds ago still means: after the time-out, nothing."""
    # Ages are sums of ticks; a hair less than the time-out is the time-out.
    return command if age < timeout - TICK / 1000 else STILL

"""Reads the parameters of the sensors: `odom0`, `odom1` and so on, `pose0`, `twist0`, `imu0`."""

from collections.abc import Callable, Iterator
from itertools import count, takewhile

from bringup.filter.parameter_reader import Reader
from bringup.filter.settings import NEVER_REJECT, Flags, Kind, Part, Sensor
from bringup.filter.state import ACCELERATION, POSE, SIZE, TWIST

_NOTHING: Flags = (False,) * SIZE
_NO_POSITION: Flags = (False, False, False)


def read_sensors(reader: Reader) -> tuple[Sensor, ...]:
    """Read every sensor of use; the numbers of a kind count from 0 and end at the first gap."""
    return tuple(
        sensor
        for kind, read in _KINDS.items()
        for name in _names(reader, kind)
        if _is_of_use(sensor := read(reader, name), reader)
    )


def _names(reader: Reader, kind: Kind) -> Iterator[str]:
    return takewhile(reader.has, (f"{kind}{number}" for number in count()))


def _is_of_use(sensor: Sensor, reader: Reader) -> bool:
    if not sensor.topic:
        reader.report.error(f"parameter {sensor.name} must be a topic; the sensor is not used")
        return False
    if sensor.pose or sensor.twist or sensor.acceleration:
        return True
    reader.report.warning(
        f"{sensor.name}_config enables nothing that {sensor.topic} measures; it is not subscribed"
    )
    return False


def _odometry(reader: Reader, name: str) -> Sensor:
    flags = _config(reader, name)
    differential, relative = _pose_modes(reader, name)
    pose = Part(
        name=f"{name}_pose",
        flags=flags[POSE],
        threshold=reader.threshold(f"{name}_pose_rejection_threshold", NEVER_REJECT),
        differential=differential,
        relative=relative,
        use_child_frame=reader.boolean(f"{name}_pose_use_child_frame"),
    )
    threshold = reader.threshold(f"{name}_twist_rejection_threshold", NEVER_REJECT)
    twist = Part(name=f"{name}_twist", flags=flags[TWIST], threshold=threshold)
    widens = reader.boolean(f"{name}_widens_start")
    return _sensor(reader, name, "odom", pose=_used(pose), twist=_used(twist), widens_start=widens)


def _pose(reader: Reader, name: str) -> Sensor:
    flags = _config(reader, name)
    differential, relative = _pose_modes(reader, name)
    pose = Part(
        name=name,
        flags=flags[POSE],
        threshold=reader.threshold(f"{name}_rejection_threshold", NEVER_REJECT),
        differential=differential,
        relative=relative,
    )
    return _sensor(reader, name, "pose", pose=_used(pose))


def _twist(reader: Reader, name: str) -> Sensor:
    flags = _config(reader, name)
    threshold = reader.threshold(f"{name}_rejection_threshold", NEVER_REJECT)
    return _sensor(reader, name, "twist", twist=_used(Part(name, flags[TWIST], threshold)))


def _imu(reader: Reader, name: str) -> Sensor:
    flags = _config(reader, name)
    if any(flags[:3]) or any(flags[6:9]):
        reader.report.warning(f"{name}_config enables positions or linear velocities, which no IMU measures")
    differential, relative = _pose_modes(reader, name)
    pose = Part(
        name=f"{name}_pose",
        flags=_NO_POSITION + flags[3:6],
        threshold=reader.threshold(f"{name}_pose_rejection_threshold", NEVER_REJECT),
        differential=differential,
        relative=relative,
    )
    twist_threshold = reader.threshold(f"{name}_twist_rejection_threshold", NEVER_REJECT)
    twist = Part(f"{name}_twist", _NO_POSITION + flags[9:12], twist_threshold)
    # Whether the orientation is relative also decides which way is down.
    acceleration = Part(
        name=f"{name}_acceleration",
        flags=flags[ACCELERATION],
        threshold=reader.threshold(f"{name}_linear_acceleration_rejection_threshold", NEVER_REJECT),
        relative=relative,
    )
    remove_gravity = reader.boolean(f"{name}_remove_gravitational_acceleration")
    return _sensor(
        reader,
        name,
        "imu",
        pose=_used(pose),
        twist=_used(twist),
        acceleration=_used(acceleration),
        remove_gravity=remove_gravity,
    )


_KINDS: dict[Kind, Callable[[Reader, str], Sensor]] = {
    "odom": _odometry,
    "pose": _pose,
    "twist": _twist,
    "imu": _imu,
}


def _sensor(
    reader: Reader,
    name: str,
    kind: Kind,
    *,
    pose: Part | None = None,
    twist: Part | None = None,
    acceleration: Part | None = None,
    remove_gravity: bool = False,
    widens_start: bool = False,
) -> Sensor:
    return Sensor(
        name=name,
        kind=kind,
        topic=reader.text(name, ""),
        queue_size=reader.count(f"{name}_queue_size", 10),
        pose=pose,
        twist=twist,
        acceleration=acceleration,
        remove_gravity=remove_gravity,
        widens_start=widens_start,
    )


def _config(reader: Reader, name: str) -> Flags:
    name = f"{name}_config"
    flags = reader.flags(name)
    if flags is None:
        reader.in_force.setdefault(name, list(_NOTHING))
        return _NOTHING
    if len(flags) != SIZE:
        reader.report.warning(
            f"parameter {name} has {len(flags)} entries, not {SIZE}; those that are missing count as false"
        )
    return (flags + _NOTHING)[:SIZE]


def _pose_modes(reader: Reader, name: str) -> tuple[bool, bool]:
    differential = reader.boolean(f"{name}_differential")
    relative = reader.boolean(f"{name}_relative")
    if differential and relative:
        reader.report.warning(
            f"{name}_differential and {name}_relative are both set; only differential is used"
        )
    return differential, relative and not differential


def _used(part: Part) -> Part | None:
    return part if any(part.flags) else None

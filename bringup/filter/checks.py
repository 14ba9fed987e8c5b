"""Doubts about a configuration as a whole: variables that are measured too often or not at all."""

from collections.abc import Iterator

from bringup.filter.notices import Level
from bringup.filter.settings import Part, Settings
from bringup.filter.state import NAMES, OUT_OF_PLANE, POSE, SIZE, TWIST, VX

_VELOCITY_OF = VX  # How far behind a pose variable its velocity stands.


def doubts(settings: Settings) -> Iterator[tuple[Level, str, str]]:
    """List severity, key and text of each doubt.

    A pose variable with more than one absolute source makes the estimate jump between them (upstream: warning);
    one with neither itself nor its velocity measured drifts without bound (upstream: error).
    """
    absolute, velocities = _sources(settings)
    for variable in range(POSE.start, POSE.stop):
        key = f"{NAMES[variable]}_configuration"
        sources = absolute[variable]
        if len(sources) > 1:
            text = f"{NAMES[variable]} has several absolute sources ({', '.join(sources)})"
            yield Level.WARN, key, f"{text}; all but one should be differential or measure the velocity"
        exempt = settings.estimation.two_d_mode and variable in OUT_OF_PLANE
        if not sources and not velocities[variable] and not exempt:
            yield (
                Level.ERROR,
                key,
                f"neither {NAMES[variable]} nor its velocity is measured: it drifts without bound",
            )


def _sources(settings: Settings) -> tuple[list[list[str]], list[list[str]]]:
    """Name for each variable the parts that measure it, and those that measure its velocity."""
    absolute: list[list[str]] = [[] for _ in range(SIZE)]
    velocities: list[list[str]] = [[] for _ in range(SIZE)]
    for sensor in settings.sensors:
        for variable in _variables(sensor.pose, POSE.start):
            differential = sensor.pose is not None and sensor.pose.differential
            (velocities if differential else absolute)[variable].append(sensor.name)
        for variable in _variables(sensor.twist, TWIST.start):
            velocities[variable - _VELOCITY_OF].append(sensor.name)
    return absolute, velocities


def _variables(part: Part | None, offset: int) -> list[int]:
    return [] if part is None else [entry + offset for entry, on in enumerate(part.flags) if on]

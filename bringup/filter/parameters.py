"""Turns parameters, in the names of robot_localization's `ekf.yaml`, into settings.

What upstream goes on with is a warning, what keeps it from starting (a value of another type) an error; only a
covariance of a wrong size stops the start here too. A parameter that is set and that nobody reads is told as well.
"""

from collections.abc import Mapping

import numpy as np

from bringup.filter.parameter_reader import ParameterError, Reader, Report
from bringup.filter.sensor_parameters import read_sensors
from bringup.filter.settings import (
    NANOSECONDS,
    Control,
    Estimation,
    Frames,
    Publication,
    Sensor,
    Settings,
    Timing,
)
from bringup.filter.state import SIZE, Array
from bringup.filter.unknown_parameters import tell_unread

DEFAULT_PROCESS_NOISE = (
    *(0.05, 0.05, 0.06, 0.03, 0.03, 0.06),
    *(0.025, 0.025, 0.04, 0.01, 0.01, 0.02),
    *(0.01, 0.01, 0.015),
)
_DEFAULT_VARIANCE = 1e-9
_CONTROL_AXES = 6
_CONTROL_AXIS_NAMES = ("x", "y", "z")
_ONES = (1.0,) * _CONTROL_AXES
# What only counts with use_control.
_OF_CONTROL = (
    *("stamped_control", "control_timeout", "control_config", "acceleration_limits", "acceleration_gains"),
    *("deceleration_limits", "deceleration_gains"),
)


def read_settings(values: Mapping[str, object], report: Report) -> tuple[Settings, dict[str, object]]:
    """Read all parameters of a filter.

    Returns the settings and, by parameter name, the values in force with defaults filled in.
    Raises ParameterError if a covariance has neither 15 nor 225 entries.
    """
    reader = Reader(values, report)
    frames = _frames(reader)
    sensors = read_sensors(reader)
    settings = Settings(
        frames=frames,
        sensors=sensors,
        estimation=_estimation(reader),
        timing=_timing(reader),
        publication=_publication(reader),
        control=_control(reader, sensors),
    )
    tell_unread(reader, _OF_CONTROL)
    return settings, reader.in_force


def _frames(reader: Reader) -> Frames:
    prefix = reader.text("tf_prefix", "").strip("/")

    def prefixed(name: str) -> str:
        return f"{prefix}/{name}" if prefix else name

    odom = reader.text("odom_frame", "odom").lstrip("/")
    base = reader.text("base_link_frame", "base_link").lstrip("/")
    frames = Frames(
        map=prefixed(reader.text("map_frame", "map").lstrip("/")),
        odom=prefixed(odom),
        base_link=prefixed(base),
        base_link_output=prefixed(reader.text("base_link_frame_output", base).lstrip("/")),
        world=prefixed(reader.text("world_frame", odom).lstrip("/")),
    )
    _check_frames(frames, reader.report)
    return frames


def _check_frames(frames: Frames, report: Report) -> None:
    if len({frames.map, frames.odom, frames.base_link}) < len(("map", "odom", "base_link")):
        report.warning(
            "invalid frames: map_frame, odom_frame and base_link_frame must differ, but are "
            f"{frames.map}, {frames.odom} and {frames.base_link}"
        )
    if frames.base_link_output in {frames.map, frames.odom}:
        report.warning(
            f"invalid frames: base_link_frame_output {frames.base_link_output} must differ from "
            "map_frame and odom_frame"
        )
    if frames.world not in {frames.map, frames.odom}:
        report.warning(
            f"invalid frames: world_frame {frames.world} must be the odom_frame {frames.odom} "
            f"or the map_frame {frames.map}; no transform is broadcast"
        )


def _estimation(reader: Reader) -> Estimation:
    initial = reader.numbers("initial_state")
    if initial is not None and len(initial) != SIZE:
        reader.report.warning(
            f"parameter initial_state has {len(initial)} entries, not {SIZE}; it is not used"
        )
        initial = None
    return Estimation(
        process_noise=_covariance(reader, "process_noise_covariance", DEFAULT_PROCESS_NOISE),
        initial_covariance=_covariance(reader, "initial_estimate_covariance", (_DEFAULT_VARIANCE,) * SIZE),
        initial_state=np.array(initial if initial is not None else (0.0,) * SIZE),
        dynamic_process_noise=reader.boolean("dynamic_process_noise_covariance"),
        two_d_mode=reader.boolean("two_d_mode"),
        gravity=reader.number("gravitational_acceleration", 9.80665),
    )


def _covariance(reader: Reader, name: str, diagonal: tuple[float, ...]) -> Array:
    values = reader.numbers(name)
    if values is None:
        reader.in_force.setdefault(name, list(diagonal))
        return np.diag(diagonal)
    if len(values) == SIZE:
        return np.diag(values)
    if len(values) == SIZE * SIZE:
        return np.array(values).reshape(SIZE, SIZE)
    raise ParameterError(
        f"parameter {name} has {len(values)} entries; it needs {SIZE} (the diagonal) or {SIZE * SIZE} (row by row)"
    )


def _timing(reader: Reader) -> Timing:
    frequency = reader.positive("frequency", 30.0)
    smooth = reader.boolean("smooth_lagged_data")
    history = reader.number("history_length", 0.0)
    if history < 0.0:
        reader.report.warning(f"parameter history_length is negative ({history}); {-history} is used")
        history = -history
    if history > 0.0 and not smooth:
        reader.report.warning("parameter history_length has no effect without smooth_lagged_data")
    jumps = reader.boolean("reset_on_time_jump")
    simulated = reader.boolean("use_sim_time")
    return Timing(
        frequency=frequency,
        sensor_timeout=_nanoseconds(reader.number("sensor_timeout", 1.0 / frequency)),
        transform_timeout=_nanoseconds(reader.number("transform_timeout", 0.0)),
        history_length=_nanoseconds(history),
        predict_to_current_time=reader.boolean("predict_to_current_time"),
        smooth_lagged_data=smooth,
        # A clock that is not simulated is set now and then, which is no other time.
        reset_on_time_jump=jumps and simulated,
        disabled_at_startup=reader.boolean("disabled_at_startup"),
    )


def _publication(reader: Reader) -> Publication:
    return Publication(
        transform=reader.boolean("publish_tf", default=True),
        transform_offset=_nanoseconds(reader.number("transform_time_offset", 0.0)),
        acceleration=reader.boolean("publish_acceleration"),
        corrections=reader.boolean("permit_corrected_publication"),
        diagnostics=reader.boolean("print_diagnostics"),
        debug_file=_debug_file(reader),
    )


def _debug_file(reader: Reader) -> str | None:
    wanted = reader.boolean("debug")
    file = reader.text("debug_out_file", "robot_localization_debug.txt")
    return file if wanted else None


def _control(reader: Reader, sensors: tuple[Sensor, ...]) -> Control | None:
    if not reader.boolean("use_control"):
        reader.know(*_OF_CONTROL)
        return None
    stamped = reader.boolean("stamped_control")
    timeout = reader.number("control_timeout", 0.0)
    axes = _controlled_axes(reader)
    limits = _six(reader, "acceleration_limits", _ONES)
    gains = _six(reader, "acceleration_gains", _ONES) or _ONES
    braking_limits = _six(reader, "deceleration_limits", limits)
    braking_gains = _six(reader, "deceleration_gains", gains) or _ONES
    if axes is None or limits is None or braking_limits is None:
        reader.report.warning("use_control is set, but its parameters are not usable; control is off")
        return None
    axes = _without_measured(axes, sensors, reader.report)
    if not any(axes):
        reader.report.warning("use_control is set, but no axis is left to be controlled; control is off")
        return None
    return Control(
        axes=axes,
        timeout=_nanoseconds(timeout),
        acceleration_limits=limits,
        acceleration_gains=gains,
        deceleration_limits=braking_limits,
        deceleration_gains=braking_gains,
        stamped=stamped,
    )


def _controlled_axes(reader: Reader) -> tuple[bool, ...] | None:
    axes = reader.flags("control_config")
    if axes is not None and len(axes) == _CONTROL_AXES:
        return axes
    what = f"has {len(axes)} entries" if axes is not None else "is missing"
    reader.report.warning(f"parameter control_config {what}; it must be a list of {_CONTROL_AXES} booleans")
    return None


def _six(reader: Reader, name: str, default: tuple[float, ...] | None) -> tuple[float, ...] | None:
    values = reader.numbers(name)
    if values is None and not reader.has(name):
        if default is not None:
            reader.in_force[name] = list(default)
        return default
    if values is None or len(values) != _CONTROL_AXES:
        reader.report.warning(f"parameter {name} needs {_CONTROL_AXES} numbers; it is not used")
        return None
    return values


def _without_measured(
    axes: tuple[bool, ...], sensors: tuple[Sensor, ...], report: Report
) -> tuple[bool, ...]:
    """Drop the control of each linear axis whose acceleration an IMU measures: they would contradict."""
    kept = list(axes)
    for sensor in sensors:
        if sensor.acceleration is None:
            continue
        for axis, measured in enumerate(sensor.acceleration.flags):
            if measured and kept[axis]:
                name = _CONTROL_AXIS_NAMES[axis]
                report.warning(f"{sensor.name} measures the acceleration along {name}; its control is off")
                kept[axis] = False
    return tuple(kept)


def _nanoseconds(seconds: float) -> int:
    return round(seconds * NANOSECONDS)

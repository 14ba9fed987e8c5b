from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml

import bringup
from bringup.filter.checks import doubts
from bringup.filter.parameter_reader import ParameterError
from bringup.filter.parameters import DEFAULT_PROCESS_NOISE, read_settings
from bringup.filter.settings import NANOSECONDS, NEVER_REJECT, Settings

ON = [True] * 15
VX = [index == 6 for index in range(15)]


def test_nothing_set_means_the_documented_defaults(settings_of: Callable[..., Settings]) -> None:
    settings = settings_of()
    assert settings.sensors == ()
    assert settings.timing.frequency == 30.0
    assert settings.timing.sensor_timeout == round(NANOSECONDS / 30)
    assert (settings.estimation.process_noise == np.diag(DEFAULT_PROCESS_NOISE)).all()
    assert (settings.estimation.initial_covariance == np.eye(15) * 1e-9).all()
    assert settings.publication.transform
    assert not settings.estimation.two_d_mode
    assert settings.control is None


def test_the_shipped_file_fuses_wheel_speed_and_turning_rate(complaints: Any) -> None:
    text = (Path(bringup.__file__).parent / "params" / "ekf.yaml").read_text()
    parameters = yaml.safe_load(text)["/**/ekf"]["ros__parameters"]
    settings, _ = read_settings(parameters, complaints)
    assert (complaints.warnings, complaints.errors) == ([], [])
    odometry, imu = settings.sensors
    assert (odometry.topic, imu.topic) == ("wheel/odometry", "imu/data")
    assert odometry.twist is not None
    assert odometry.twist.flags == (True, True, False, False, False, False)
    assert odometry.pose is None
    assert imu.twist is not None
    assert imu.twist.flags == (False,) * 5 + (True,)
    assert settings.timing.frequency == 50.0
    assert settings.estimation.two_d_mode
    assert list(doubts(settings)) == []


def test_whole_numbers_count_as_doubles(settings_of: Callable[..., Settings]) -> None:
    settings = settings_of(
        frequency=30, sensor_timeout=1, initial_state=[1] * 15, process_noise_covariance=[2] * 15
    )
    assert settings.timing.frequency == 30.0
    assert settings.timing.sensor_timeout == NANOSECONDS
    assert (settings.estimation.process_noise == np.eye(15) * 2.0).all()


def test_exponents_that_yaml_takes_for_text_are_numbers(settings_of: Callable[..., Settings]) -> None:
    parameters = yaml.safe_load(f"{{sensor_timeout: 1e-1, initial_estimate_covariance: {['1e-3'] * 15}}}")
    assert parameters["sensor_timeout"] == "1e-1", "PyYAML reads YAML 1.1"
    settings = settings_of(**parameters)
    assert settings.timing.sensor_timeout == NANOSECONDS // 10
    assert (settings.estimation.initial_covariance == np.eye(15) * 1e-3).all()


def test_a_full_covariance_is_read_row_by_row(settings_of: Callable[..., Settings]) -> None:
    values = np.arange(225.0)
    settings = settings_of(initial_estimate_covariance=list(values))
    assert (settings.estimation.initial_covariance == values.reshape(15, 15)).all()


@pytest.mark.parametrize("name", ["process_noise_covariance", "initial_estimate_covariance"])
def test_a_covariance_of_another_size_stops_the_start(complaints: Any, name: str) -> None:
    with pytest.raises(ParameterError, match=f"{name} has 14 entries; it needs 15"):
        read_settings({name: [0.1] * 14}, complaints)


def test_sensors_are_counted_up_to_the_first_gap(complaints: Any) -> None:
    parameters = {f"odom{number}": f"topic{number}" for number in (0, 1, 3)}
    configs = {f"odom{number}_config": ON for number in (0, 1, 3)}
    settings, _ = read_settings({**parameters, **configs}, complaints)
    assert [sensor.topic for sensor in settings.sensors] == ["topic0", "topic1"]
    assert any("odom3" in warning for warning in complaints.warnings)


def test_every_kind_fuses_the_parts_it_measures(settings_of: Callable[..., Settings]) -> None:
    names = ("odom0", "pose0", "twist0")
    settings = settings_of(**{name: name for name in names}, **{f"{name}_config": ON for name in names})
    parts = {sensor.name: (sensor.pose, sensor.twist, sensor.acceleration) for sensor in settings.sensors}
    named = {name: [part.name if part else None for part in found] for name, found in parts.items()}
    assert named == {
        "odom0": ["odom0_pose", "odom0_twist", None],
        "pose0": ["pose0", None, None],
        "twist0": [None, "twist0", None],
    }


def test_thresholds_and_modes_reach_their_parts(settings_of: Callable[..., Settings]) -> None:
    settings = settings_of(
        odom0="odom",
        odom0_config=ON,
        odom0_queue_size=3,
        odom0_differential=True,
        odom0_pose_rejection_threshold=2,
        odom0_twist_rejection_threshold=3.5,
        odom0_pose_use_child_frame=True,
    )
    (sensor,) = settings.sensors
    assert sensor.pose is not None
    assert sensor.twist is not None
    assert sensor.queue_size == 3
    assert (sensor.pose.threshold, sensor.twist.threshold) == (2.0, 3.5)
    assert sensor.pose.differential
    assert sensor.pose.use_child_frame


@pytest.mark.parametrize(
    ("parameters", "error"),
    [
        ({"frequency": "fast"}, "frequency must be a number, not 'fast'; 30.0 is used"),
        ({"frequency": 0.0}, "frequency must be greater than zero"),
        ({"two_d_mode": 1}, "two_d_mode must be true or false"),
        ({"odom0": 5}, "odom0 must be a string"),
        ({"odom0": ""}, "odom0 must be a topic"),
        ({"odom0": "o", "odom0_config": [1] * 15}, "odom0_config must be a list of booleans"),
        (
            {"odom0": "o", "odom0_config": VX, "odom0_queue_size": 2.5},
            "odom0_queue_size must be a whole number",
        ),
        ({"odom0": "o", "odom0_config": VX, "odom0_pose_rejection_threshold": "far"}, "must be a number"),
        ({"initial_state": "zero"}, "initial_state must be a list of numbers"),
    ],
)
def test_a_value_of_another_type_is_an_error_that_names_it(
    complaints: Any, parameters: Mapping[str, object], error: str
) -> None:
    read_settings(parameters, complaints)
    assert any(error in told for told in complaints.errors), complaints.errors


@pytest.mark.parametrize(
    ("parameters", "warning"),
    [
        ({"odom0": "o", "odom0_config": [True] * 14}, "odom0_config has 14 entries, not 15"),
        ({"odom0": "o"}, "odom0_config enables nothing that o measures; it is not subscribed"),
        ({"pose0": "p", "pose0_config": VX}, "pose0_config enables nothing"),
        (
            {"odom0": "o", "odom0_config": VX, "odom0_queue_size": 0},
            "odom0_queue_size must be a whole number",
        ),
        (
            {"odom0": "o", "odom0_config": ON, "odom0_differential": True, "odom0_relative": True},
            "only differential is used",
        ),
        ({"initial_state": [0.0] * 3}, "initial_state has 3 entries, not 15"),
        ({"map_frame": "odom"}, "map_frame, odom_frame and base_link_frame must differ"),
        ({"base_link_frame_output": "odom"}, "base_link_frame_output odom must differ"),
        ({"world_frame": "mars"}, "world_frame mars must be the odom_frame odom or the map_frame map"),
        ({"smooth_lagged_data": True, "history_length": -2.0}, "history_length is negative"),
        ({"history_length": 2.0}, "no effect without smooth_lagged_data"),
        ({"use_control": True}, "control_config is missing"),
        ({"use_control": True, "control_config": [True] * 5}, "a list of 6 booleans"),
        ({"use_control": True, "control_config": [False] * 6}, "no axis is left to be controlled"),
        (
            {"use_control": True, "control_config": [True] * 6, "acceleration_limits": [1.0]},
            "acceleration_limits needs 6 numbers",
        ),
        ({"frequencie": 30.0}, "frequencie is unknown and has no effect; did you mean frequency?"),
        ({"imu0": "i", "imu0_config": ON}, "imu0_config enables positions or linear velocities"),
        ({"odom1": "o"}, "odom1 is unknown and has no effect; odom0 is missing"),
        ({"pose0_config": ON}, "pose0_config is unknown and has no effect; pose0, its topic, is missing"),
        ({"odom0": "o", "odom0_config": VX, "odom0_nodelay": True}, "odom0_nodelay is unknown"),
        ({"imu0_differental": True}, "did you mean imu0_differential?"),
        ({"base_link_output_frame": "b"}, "did you mean base_link_frame_output?"),
        ({"zzz": 1}, "zzz is unknown and has no effect; the nearest name is"),
        ({"odm0": "o"}, "did you mean odom0?"),
        ({"twist0": "t", "twist0_config": VX, "twist0_relatve": True}, "has no effect; did you mean twist0"),
        ({"odmo0_config": VX}, "did you mean odom0_config?"),
        ({"imuO": "i"}, "did you mean imu0?"),
        ({"control_confg": [True] * 6}, "did you mean control_config?"),
        ({"gravity": 9.8}, "did you mean gravitational_acceleration?"),
        ({"sensor_timeout": float("inf")}, "sensor_timeout must be a finite number"),
        ({"initial_estimate_covariance": [float("nan")] * 15}, "must be a list of finite numbers"),
    ],
)
def test_what_upstream_goes_on_with_is_a_warning_and_no_error(
    complaints: Any, parameters: Mapping[str, object], warning: str
) -> None:
    read_settings(parameters, complaints)
    assert any(warning in told for told in complaints.warnings), complaints.warnings
    assert complaints.errors == []


def test_everything_that_upstreams_example_sets_is_read(complaints: Any) -> None:
    """Its `params/ekf.yaml`; only the ROS 1 rest in it, which upstream does not read either, has no effect."""
    sensors: dict[str, object] = {
        "odom0": "example/odom",
        "odom0_queue_size": 2,
        "odom0_pose_rejection_threshold": 5.0,
        "odom0_twist_rejection_threshold": 1.0,
        "pose0": "example/pose",
        "pose0_differential": True,
        "pose0_rejection_threshold": 2.0,
        "twist0": "example/twist",
        "twist0_rejection_threshold": 2.0,
        "imu0": "example/imu",
        "imu0_relative": True,
        "imu0_pose_rejection_threshold": 0.8,
        "imu0_twist_rejection_threshold": 0.8,
        "imu0_linear_acceleration_rejection_threshold": 0.8,
        "imu0_remove_gravitational_acceleration": True,
        "imu0_config": [index in {3, 4, 5, 9, 10, 11, 12, 13, 14} for index in range(15)],
        **{
            f"{name}0_config": [index in {0, 1, 6} for index in range(15)]
            for name in ("odom", "pose", "twist")
        },
    }
    control = {
        "use_control": True,
        "stamped_control": False,
        "control_timeout": 0.2,
        "control_config": [True, False, False, False, False, True],
        "acceleration_limits": [1.3, 0.0, 0.0, 0.0, 0.0, 3.4],
        "deceleration_limits": [1.3, 0.0, 0.0, 0.0, 0.0, 4.5],
        "acceleration_gains": [0.8, 0.0, 0.0, 0.0, 0.0, 0.9],
        "deceleration_gains": [1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
    }
    rest = {
        "frequency": 30.0,
        "sensor_timeout": 0.1,
        "transform_time_offset": 0.0,
        "transform_timeout": 0.0,
        "print_diagnostics": True,
        "debug": False,
        "debug_out_file": "/path/to/debug/file.txt",
        "permit_corrected_publication": False,
        "publish_acceleration": False,
        "initial_estimate_covariance": list(np.diag([1e-9] * 15).reshape(-1)),
        "process_noise_covariance": list(np.diag(DEFAULT_PROCESS_NOISE).reshape(-1)),
    }
    settings, _ = read_settings({**sensors, **control, **rest, "odom0_nodelay": False}, complaints)
    assert complaints.errors == []
    assert len(complaints.warnings) == 2, complaints.warnings
    assert "odom0_nodelay is unknown" in complaints.warnings[1]
    assert [sensor.name for sensor in settings.sensors] == ["odom0", "pose0", "twist0", "imu0"]
    assert settings.control is not None
    assert settings.control.axes == (False, False, False, False, False, True), "the IMU measures ax"


def test_control_parameters_are_nobodys_business_without_control(
    settings_of: Callable[..., Settings],
) -> None:
    settings = settings_of(use_control=False, control_config=[], acceleration_limits=[1.0], control_timeout=1)
    assert settings.control is None


@pytest.mark.parametrize("name", ["acceleration_gains", "deceleration_gains"])
def test_gains_of_a_wrong_size_are_all_one(complaints: Any, name: str) -> None:
    given = {"acceleration_gains": [3.0] * 6, "deceleration_gains": [3.0] * 6, name: [3.0]}
    settings, _ = read_settings({"use_control": True, "control_config": [True] * 6, **given}, complaints)
    assert settings.control is not None
    assert getattr(settings.control, name) == (1.0,) * 6


def test_flags_that_are_missing_count_as_false(complaints: Any) -> None:
    settings, _ = read_settings({"twist0": "t", "twist0_config": [False] * 6 + [True]}, complaints)
    twist = settings.sensors[0].twist
    assert twist is not None
    assert twist.flags == (True, False, False, False, False, False)


def test_a_threshold_out_of_reach_rejects_nothing(settings_of: Callable[..., Settings]) -> None:
    settings = settings_of(pose0="p", pose0_config=ON, pose0_rejection_threshold=float("inf"))
    pose = settings.sensors[0].pose
    assert pose is not None
    assert pose.threshold == NEVER_REJECT


def test_a_parameter_without_a_value_is_not_set(settings_of: Callable[..., Settings]) -> None:
    assert settings_of(frequency=None, odom0=None).timing.frequency == 30.0


@pytest.mark.parametrize(("debug", "file"), [(False, None), (True, "trace.txt")])
def test_debugging_goes_to_its_file(settings_of: Callable[..., Settings], file: str, *, debug: bool) -> None:
    assert settings_of(debug=debug, debug_out_file="trace.txt").publication.debug_file == file


def test_differential_wins_over_relative(complaints: Any) -> None:
    both = {"odom0": "o", "odom0_config": ON, "odom0_differential": True, "odom0_relative": True}
    settings, _ = read_settings(both, complaints)
    pose = settings.sensors[0].pose
    assert pose is not None
    assert (pose.differential, pose.relative) == (True, False)


def test_frames_take_a_prefix_and_lose_leading_slashes(settings_of: Callable[..., Settings]) -> None:
    frames = settings_of(tf_prefix="robot1", odom_frame="/odom", base_link_frame="base").frames
    assert (frames.odom, frames.world, frames.base_link) == ("robot1/odom", "robot1/odom", "robot1/base")
    assert frames.base_link_output == "robot1/base"


def test_controlled_axes_that_an_imu_measures_are_left_to_it(complaints: Any) -> None:
    settings, _ = read_settings(
        {
            "use_control": True,
            "control_config": [True] * 6,
            "imu0": "imu",
            "imu0_config": [index == 12 for index in range(15)],
        },
        complaints,
    )
    assert settings.control is not None
    assert settings.control.axes == (False, True, True, True, True, True)
    assert complaints.warnings == ["imu0 measures the acceleration along x; its control is off"]


def test_defaults_in_force_are_told(complaints: Any) -> None:
    _, in_force = read_settings({"frequency": 10, "odom0": "o", "odom0_config": VX}, complaints)
    assert in_force["frequency"] == 10.0
    assert in_force["sensor_timeout"] == 0.1
    assert in_force["odom0_queue_size"] == 10
    assert in_force["process_noise_covariance"] == list(DEFAULT_PROCESS_NOISE)


def test_doubts_name_variables_measured_twice_or_never(settings_of: Callable[..., Settings]) -> None:
    x_and_vx = [index in {0, 6} for index in range(15)]
    settings = settings_of(
        odom0="a", odom0_config=x_and_vx, pose0="b", pose0_config=x_and_vx, two_d_mode=True
    )
    found = {key: text for _, key, text in doubts(settings)}
    assert set(found) == {"X_configuration", "Y_configuration", "YAW_configuration"}
    assert "odom0, pose0" in found["X_configuration"]

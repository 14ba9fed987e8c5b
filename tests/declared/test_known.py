"""What well-known nodes declare: told where a value or a name is certainly wrong, and silent about all else."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.declared.common import KNOWN
from orchestra.declared.known import known_schema
from orchestra.declared.known_nodes import NODES

if TYPE_CHECKING:
    from orchestra.values import ParameterValue

_FLAGS = (True, False, True) * 5


@pytest.mark.parametrize(
    ("name", "value", "meant"),
    [
        ("frequency", 30, "30.0"),
        ("two_d_mode", "true", "true"),
        ("odom_frame", 1, '"1"'),
        ("freqency", 30.0, "frequency"),
        ("odom0_cofnig", _FLAGS, "odom0_config"),
        ("twist_config", _FLAGS, "twist0_config"),
        ("initial_state", (0.0,) * 14, None),
        ("world_frame", "base_link", "odom"),
    ],
)
def test_a_parameter_of_a_filter_is_told(name: str, value: ParameterValue, meant: str | None) -> None:
    schema = known_schema("robot_localization", "ekf_node")
    assert schema is not None
    told = list(schema.faults({name: value}))
    assert [(fault.name, fault.meant, fault.certain) for fault in told] == [(name, meant, False)]


@pytest.mark.parametrize(
    "values",
    [
        {"frequency": 30.0, "imu0": "imu/data", "imu0_config": _FLAGS, "imu0_queue_size": 5},
        {"world_frame": "map"},
        {"world_frame": "utm", "publish_tf": False},
        {"odom1_config": _FLAGS[:14], "odom1_queue_size": 10.0},
        {"use_control": False, "control_config": (True,), "acceleration_limits": (1, 0, 0, 0, 0, 3)},
        {"world_frame": "robot1/odom", "odom_frame": "robot1/odom"},
        {"odom0_nodelay": True, "use_sim_time": True, "a_new_one": 1},
        {"imu_frame": "imu", "publish_rate": 20, "silent_tf_failure": True},
        {"twist0": "speed", "twist1": "speed", "process_noise_covariance": (0.1,) * 225},
    ],
)
def test_what_may_be_right_stays_silent(values: dict[str, ParameterValue]) -> None:
    """Names that are like none may be those of another version."""
    schema = known_schema("robot_localization", "ekf_node")
    assert schema is not None
    assert list(schema.faults(values)) == []


@pytest.mark.parametrize(
    "values",
    [
        {"imu0": "imu/data", "imu0_config": _FLAGS[:14]},
        {"use_control": True, "control_config": (True,)},
        {"use_control": True, "acceleration_limits": (1, 0, 0, 0, 0, 3)},
    ],
)
def test_what_the_node_looks_at_is_told(values: dict[str, ParameterValue]) -> None:
    schema = known_schema("robot_localization", "ekf_node")
    assert schema is not None
    assert [fault.name for fault in schema.faults(values)] == [list(values)[-1]]


@pytest.mark.parametrize(
    ("node", "name", "meant"),
    [
        (("robot_localization", "ekf_node"), "base_link_output_frame", "base_link_frame_output"),
        (("robot_localization", "ekf_node"), "sensor_time_out", "sensor_timeout"),
        (("nav2_amcl", "amcl"), "initial_pose_x", "initial_pose.x"),
        (("nav2_amcl", "amcl"), "max_particels", "max_particles"),
        (("nav2_lifecycle_manager", "lifecycle_manager"), "node_name", "node_names"),
        (("teleop_twist_joy", "teleop_node"), "axis_linaer.x", "axis_linear"),
    ],
)
def test_a_slip_for_a_name_is_told(node: tuple[str, str], name: str, meant: str) -> None:
    schema = known_schema(*node)
    assert schema is not None
    assert [(fault.kind, fault.meant) for fault in schema.faults({name: 1.5})] == [("undeclared", meant)]


@pytest.mark.parametrize("name", ["odom_model_type", "save_pose_delay", "laser_topic", "use_map_topic"])
def test_a_name_of_other_words_is_no_slip(name: str) -> None:
    """Another version may declare it, or a file be for several nodes."""
    schema = known_schema("nav2_amcl", "amcl")
    assert schema is not None
    assert list(schema.faults({name: 1.5})) == []


def test_a_number_that_is_left_out_is_the_first_that_is_free() -> None:
    schema = known_schema("robot_localization", "ukf_node")
    assert schema is not None
    told = schema.faults({"imu0": "a", "imu0_config": _FLAGS, "imu_config": _FLAGS})
    assert [fault.meant for fault in told] == ["imu1_config"]


def test_the_table_and_the_packages_are_the_same() -> None:
    assert {package for package, _ in NODES} == KNOWN
    assert all(known_schema(*node) is not None for node in NODES)


@pytest.mark.parametrize("node", [("demo", "ekf_node"), ("robot_localization", "other"), (None, "amcl")])
def test_of_other_nodes_nothing_is_known(node: tuple[str | None, str]) -> None:
    assert known_schema(*node) is None

"""What was probably meant, and what is only a slip of the keys."""

from __future__ import annotations

import pytest

from orchestra.nearest import is_one_slip, is_slip, nearest


@pytest.mark.parametrize(
    ("word", "candidates", "meant"),
    [
        ("outptu", ["output", "on_exit"], "output"),
        ("launch-prefx", ["launch_prefix"], "launch_prefix"),
        ("World", ["world", "word"], "world"),
        ("same", ["same", "sane"], "sane"),
        ("colour", ["name", "value"], None),
        ("", ["a"], None),
        ("a", [], None),
    ],
)
def test_the_nearest_word(word: str, candidates: list[str], meant: str | None) -> None:
    assert nearest(word, candidates) == meant
    assert nearest(word, reversed(candidates)) == meant


@pytest.mark.parametrize(
    ("word", "meant", "slip"),
    [
        ("exce", "exec", True),
        ("wrold", "world", True),
        ("defualt", "default", True),
        ("robot_name", "robot_sdf", False),
        ("remappings", "remap", False),
        ("robot1", "robot2", False),
        ("params_file", "slam_params_file", False),
    ],
)
def test_a_slip_of_the_keys(word: str, meant: str, slip: bool) -> None:
    assert is_slip(word, meant) is slip


@pytest.mark.parametrize(
    ("word", "meant", "slip"),
    [
        ("ymal", "yaml", True),
        ("numpi", "numpy", True),
        ("launchros", "launch_ros", True),
        ("launch-ros", "launch_ros", True),
        ("ament_index_pyton", "ament_index_python", True),
        ("subproces", "subprocess", True),
        ("sockets", "socket", False),
        ("selector", "selectors", False),
        ("scripts", "secrets", False),
        ("launch_pal", "launch_yaml", False),
        ("lxml", "xml", False),
        ("map", "mcap", False),
        ("tf2_msgs", "tf3_msgs", False),
        ("pose_x", "pose_y", False),
        ("port-b", "port_a", False),
        ("x_offset_m", "x_offset_n", False),
        ("pose_yaq", "pose_yaw", True),
    ],
)
def test_one_slip_of_the_keys(word: str, meant: str, slip: bool) -> None:
    assert is_one_slip(word, meant) is slip

"""Messages of all types, as `topic echo` writes them and `topic pub` reads them."""

from __future__ import annotations

from argparse import Namespace
from array import array
from typing import Any

import pytest

pytest.importorskip("rclpy", reason="needs ROS")

from orchestra.ros.tools.echo import renderer
from orchestra.ros.tools.messages.reading import fill, mapping_of
from tests.ros.interfaces.wheels import filled
from tests.ros.tools.rendering import OddChance, as_csv, as_yaml, message_class, message_names

_SOME = (
    "diagnostic_msgs/msg/DiagnosticArray",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "rcl_interfaces/msg/ParameterValue",
    "sensor_msgs/msg/LaserScan",
    "std_msgs/msg/Empty",
)
_PACKAGES = sorted({name.partition("/")[0] for name in message_names()})


@pytest.mark.parametrize("name", _SOME)
def test_a_message_is_written_as_ros_2_writes_it_and_read_back(name: str) -> None:
    _hold(message_class(name), OddChance(name), (None, 2))


@pytest.mark.long
@pytest.mark.parametrize("package", _PACKAGES)
def test_messages_of_all_types_are(package: str) -> None:
    for name in message_names():
        for seed in range(3) if name.startswith(f"{package}/") else ():
            _hold(message_class(name), OddChance(f"{name}{seed}"), (None, 128, 1, 0))


@pytest.mark.parametrize("csv", [False, True])
def test_a_single_value_is_written_as_it_is_with_what_is_known_of_its_message(*, csv: bool) -> None:
    about = {"source_timestamp": 1, "received_timestamp": 2}
    options = _options(128, flow_style=False, csv=csv)
    assert renderer(options)(array("d", [1.0]), about) == "array('d', [1.0])\n---\n"
    options.include_message_info = True
    told = renderer(options)("a", about)
    assert told == f"---Got new message, message info:---\n{about}\n---Message data:---\na\n---\n"


def _hold(kind: Any, chance: OddChance, lengths: tuple[int | None, ...]) -> None:
    message = filled(kind, chance)
    for length in lengths:
        for flow in (False, True):
            assert _echoed(message, length, flow_style=flow) == as_yaml(message, length, flow=flow) + "---\n"
        assert _echoed(message, length, csv=True) == as_csv(message, length) + "\n"
    again = kind()
    fill(again, mapping_of(as_yaml(message, None, flow=False)))
    assert as_yaml(again, None, flow=False) == as_yaml(message, None, flow=False)


def _echoed(message: Any, length: int | None, *, flow_style: bool = False, csv: bool = False) -> str:
    return renderer(_options(length, flow_style=flow_style, csv=csv))(message, {})


def _options(length: int | None, *, flow_style: bool, csv: bool) -> Namespace:
    return Namespace(
        full_length=length is None,
        truncate_length=length,
        truncate_given=None,
        no_arr=False,
        no_str=False,
        csv=csv,
        flow_style=flow_style,
        include_message_info=False,
        format="text",
    )

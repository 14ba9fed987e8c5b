"""Values of parameters, windows of measurements, frames, ports: what is decided apart from the graph."""

from __future__ import annotations

import math
import socket
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("rclpy", reason="needs ROS")

from rcl_interfaces.msg import ParameterType

from orchestra.errors import RunError
from orchestra.ros.tools.frames import Frames, Transform, angles, interpolated, matrix
from orchestra.ros.tools.graph.ports import participants_ports
from orchestra.ros.tools.graph.rollcall import RollCall
from orchestra.ros.tools.graph.wire.own import ANNOUNCER_AND_DETECTOR, announcement, farewell
from orchestra.ros.tools.measuring import Intervals, Window, bandwidth_text, rate_text
from orchestra.ros.tools.parameter_values import is_empty, plain_value, retyped, value_of, value_of_text


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("true", ParameterType.PARAMETER_BOOL, True),
        ("1", ParameterType.PARAMETER_INTEGER, 1),
        ("0x10", ParameterType.PARAMETER_INTEGER, 16),
        ("1.0", ParameterType.PARAMETER_DOUBLE, 1.0),
        ("!!str 1", ParameterType.PARAMETER_STRING, "1"),
        ("'1'", ParameterType.PARAMETER_STRING, "1"),
        ("1e3", ParameterType.PARAMETER_STRING, "1e3"),
        ("a: [", ParameterType.PARAMETER_STRING, "a: ["),
        ("", ParameterType.PARAMETER_STRING, ""),
        ("[true, false]", ParameterType.PARAMETER_BOOL_ARRAY, [True, False]),
        ("[1, 2]", ParameterType.PARAMETER_INTEGER_ARRAY, [1, 2]),
        ("[1, 2.5]", ParameterType.PARAMETER_DOUBLE_ARRAY, [1.0, 2.5]),
        ("[a, '1']", ParameterType.PARAMETER_STRING_ARRAY, ["a", "1"]),
        ("[]", ParameterType.PARAMETER_BOOL_ARRAY, []),
        ("null", ParameterType.PARAMETER_STRING, "null"),
        ("~", ParameterType.PARAMETER_STRING, "~"),
        ("!!binary AQI=", ParameterType.PARAMETER_BYTE_ARRAY, [b"\x01", b"\x02"]),
    ],
)
def test_a_text_has_the_type_that_yaml_gives_it(text: str, kind: int, value: object) -> None:
    made = value_of_text(text)
    assert made.type == kind
    assert plain_value(made) == value


@pytest.mark.parametrize("text", ["{a: 1}", "[1, a]", "[[1]]", "9223372036854775808"])
def test_what_no_parameter_can_be_is_an_error(text: str) -> None:
    with pytest.raises(RunError):
        value_of_text(text)


@given(
    st.booleans()
    | st.integers(-(2**63), 2**63 - 1)
    | st.floats(allow_nan=False)
    | st.text()
    | st.lists(st.booleans(), min_size=1)
    | st.lists(st.floats(allow_nan=False), min_size=1)
    | st.lists(st.text(), min_size=1)
)
def test_a_value_stays_what_it_is(data: Any) -> None:
    assert plain_value(value_of(data)) == data


def test_times_between_messages_make_a_rate() -> None:
    intervals = Intervals(3)
    for when in (0.0, 5.0, 5.5, 6.0, 6.5):
        intervals.hear(when)
    summary = intervals.summary()
    assert summary is not None
    assert (
        rate_text(summary) == "average rate: 2.000\n\tmin: 0.500s max: 0.500s std dev: 0.00000s window: 3\n"
    )
    intervals.hear(1.0)
    assert intervals.summary() is None


def test_sizes_are_told_in_the_unit_that_fits() -> None:
    sizes = Window(10)
    for size in (1000, 3000):
        sizes.add(size)
    summary = sizes.summary()
    assert summary is not None
    assert bandwidth_text(summary, 2.0) == (
        "2.00 KB/s from 2 messages\n\tMessage size mean: 2.00 KB min: 1.00 KB max: 3.00 KB\n"
    )
    assert bandwidth_text(summary, 8.0).startswith("500 B/s from 2 messages\n\tMessage size mean: 2000 B min")


def test_an_empty_list_is_of_the_type_that_the_parameter_has() -> None:
    empty, words, number = value_of([]), value_of(["a"]), value_of(1)
    assert is_empty(empty)
    assert not is_empty(words)
    assert retyped(empty, words).type == ParameterType.PARAMETER_STRING_ARRAY
    assert retyped(empty, number) == empty


_UNITS = st.floats(-1, 1)
_ANGLES = st.floats(-math.pi, math.pi)


def _turn(axis: int, angle: float) -> tuple[float, float, float, float]:
    turn = [0.0, 0.0, 0.0, math.cos(angle / 2)]
    turn[axis] = math.sin(angle / 2)
    return (turn[0], turn[1], turn[2], turn[3])


@st.composite
def _transforms(draw: st.DrawFn) -> Transform:
    place = (draw(_UNITS), draw(_UNITS), draw(_UNITS))
    made = Transform(place, (0.0, 0.0, 0.0, 1.0))
    for axis in range(3):
        made = made.then(Transform((0.0, 0.0, 0.0), _turn(axis, draw(_ANGLES))))
    return made


@given(_transforms(), _transforms())
def test_there_and_back_is_nowhere(first: Transform, second: Transform) -> None:
    both = first.then(second)
    back = both.then(second.inverse()).then(first.inverse())
    assert back.translation == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert abs(back.rotation[3]) == pytest.approx(1.0)


@given(st.floats(-3.1, 3.1), st.floats(-1.5, 1.5), st.floats(-3.1, 3.1))
def test_angles_are_those_that_made_a_rotation(roll: float, pitch: float, yaw: float) -> None:
    made = Transform((0.0, 0.0, 0.0), _turn(2, yaw))
    for axis, angle in ((1, pitch), (0, roll)):
        made = made.then(Transform((0.0, 0.0, 0.0), _turn(axis, angle)))
    assert angles(made.rotation) == pytest.approx((roll, pitch, yaw), abs=1e-6)


@given(_transforms())
def test_the_rows_of_a_rotation_are_of_length_one(transform: Transform) -> None:
    for row in matrix(transform.rotation):
        assert sum(value * value for value in row) == pytest.approx(1.0)


def test_halfway_between_two_rotations_is_half_the_angle() -> None:
    here = Transform((0.0, 0.0, 0.0), _turn(2, 0.0))
    there = Transform((2.0, 0.0, 0.0), _turn(2, 1.0))
    half = interpolated(here, there, 0.5)
    assert half.translation == (1.0, 0.0, 0.0)
    assert angles(half.rotation)[2] == pytest.approx(0.5)


def test_frames_are_told_for_the_latest_time_that_all_are_known_for() -> None:
    frames = Frames()
    for when in (1.0, 2.0, 3.0):
        frames.hear("odom", "base", when, Transform((when, 0.0, 0.0), _turn(2, 0.0)), static=False)
    frames.hear("base", "laser", 0.0, Transform((0.5, 0.0, 0.0), _turn(2, 0.0)), static=True)
    frames.hear("odom", "other", 2.5, Transform((0.0, 1.0, 0.0), _turn(2, 0.0)), static=False)
    found = frames.between("other", "laser")
    assert found is not None
    when, transform = found
    assert when == 2.5
    assert transform.translation == pytest.approx((3.0, -1.0, 0.0))
    assert frames.between("odom", "nowhere") is None


def test_participants_are_seen_by_both_of_their_ports() -> None:
    """The second socket is one of any program, whose number happens to be that of a participant."""
    head = "  sl  local_address rem_address st tx_queue rx_queue tr tm->when retrnsmt uid timeout inode\n"
    rows = [(7410, 11), (7411, 12), (7416, 13), (7660, 14), (7661, 15)]
    table = head + "".join(
        f"   1: 0100007F:{port:04X} 00000000:0000 07 00000000:00000000 00:00000000 00000000 0 0 {inode} 2 0\n"
        for port, inode in rows
    )
    assert participants_ports(0, table) == {7410: "11"}
    assert participants_ports(1, table) == {7660: "14"}


def test_a_roll_call_is_announced_and_taken_back() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as heard:
        heard.bind(("127.0.0.1", 0))
        heard.settimeout(20)
        call = RollCall(b"\x01\x0f\x00\x01", 7410)
        call.call([heard.getsockname()[1]])
        call.close()
        first, second = heard.recv(2000), heard.recv(2000)
    prefix = first[8:20]
    assert first == announcement(prefix, 7410, ANNOUNCER_AND_DETECTOR, 1)
    assert second == farewell(prefix)
    assert prefix.startswith(b"\x01\x0f\x00\x01")

"""Messages as text: as PyYAML writes it, and back."""

from __future__ import annotations

import sys
from typing import Any

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("rclpy", reason="needs ROS")

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from geometry_msgs.msg import PoseWithCovariance, TransformStamped
from sensor_msgs.msg import BatteryState, Image, LaserScan, PointCloud2
from std_msgs.msg import Byte, ByteMultiArray, Float64MultiArray, Header, Int8, String, UInt8MultiArray

from orchestra.errors import RunError
from orchestra.ros.interfaces import tf_message_type
from orchestra.ros.tools.messages.commas import csv_text
from orchestra.ros.tools.messages.expressions import field_of, passes
from orchestra.ros.tools.messages.plain import Shortening, plain
from orchestra.ros.tools.messages.reading import fill, mapping_of
from orchestra.ros.tools.messages.text import yaml_text

_TEXTS = st.text(st.characters(exclude_categories=["Cs"]), max_size=20) | st.sampled_from(
    [
        "",
        " ",
        "yes",
        "No",
        "null",
        "~",
        "1",
        "1e3",
        "0x1",
        "a: b",
        "a #b",
        "- a",
        "it's",
        "...",
        "---",
        "é",
        "a\nb",
        "=",
    ]
)
_SCALARS = st.none() | st.booleans() | st.integers() | st.floats() | _TEXTS
_DATA = st.recursive(
    _SCALARS,
    lambda below: st.lists(below, max_size=4) | st.dictionaries(_TEXTS, below, max_size=4),
    max_leaves=20,
)
_CLASSES = [
    BatteryState,
    Byte,
    ByteMultiArray,
    Float64MultiArray,
    Image,
    LaserScan,
    PointCloud2,
    PoseWithCovariance,
    TransformStamped,
]


@given(st.dictionaries(_TEXTS, _DATA, max_size=5))
def test_data_is_written_as_pyyaml_writes_it(data: dict[str, Any]) -> None:
    wanted = yaml.safe_dump(
        data, allow_unicode=True, width=sys.maxsize, sort_keys=False, default_flow_style=False
    )
    assert yaml_text(data) == wanted


@pytest.mark.parametrize("kind", _CLASSES, ids=lambda kind: kind.__name__)
def test_what_is_written_of_a_message_makes_the_same_message(kind: Any) -> None:
    message, again = kind(), kind()
    fill(again, mapping_of(yaml_text(plain(message))))
    assert again == message


def test_messages_in_messages_are_read() -> None:
    array = DiagnosticArray()
    fill(array, mapping_of("{status: [{name: a, values: [{key: b, value: 1}]}, {level: 2}]}"))
    assert array.status == [
        DiagnosticStatus(name="a", values=[KeyValue(key="b", value="1")]),
        DiagnosticStatus(level=b"\x02"),
    ]


def test_a_message_that_no_wheel_has_is_read() -> None:
    message = tf_message_type()()
    fill(message, mapping_of("{transforms: [{child_frame_id: a}]}"))
    assert plain(message)["transforms"][0]["child_frame_id"] == "a"


def test_bytes_and_numbers_fill_arrays() -> None:
    numbers, raw = Float64MultiArray(), UInt8MultiArray()
    fill(numbers, {"data": [1, 2.5, "1e3"]})
    fill(raw, {"data": [0, 255]})
    assert numbers.data.tolist() == [1.0, 2.5, 1000.0]
    assert raw.data.tolist() == [0, 255]


def test_what_is_to_have_the_current_time_is_told() -> None:
    image, header = Image(), Header()
    assert [(name, kind.__name__) for _, name, kind in fill(image, {"header": "auto"})] == [("stamp", "Time")]
    ((owner, name, _),) = fill(header, {"stamp": "now"})
    assert owner is header
    assert name == "stamp"


@pytest.mark.parametrize(
    ("message", "values", "told"),
    [
        (String(), "{dat: a}", "String has no field dat; did you mean data?"),
        (String(), "{data: [a]}", "data is a text, not ['a']"),
        (Int8(), "{data: 128}", "data is of type int8, from -128 to 127: 128 is not"),
        (Int8(), "{data: 1.5}", "data is of type int8, and 1.5 is not"),
        (LaserScan(), "{ranges: 1.0}", "ranges has several values: a list is expected, not 1.0"),
        (LaserScan(), "{header: {stamp: 3}}", "header.stamp has fields: a mapping is expected, not 3"),
        (PoseWithCovariance(), "{covariance: [1]}", "covariance has 36 values, not 1"),
        (String(), "[1]", "The passed value needs to be a dictionary in YAML format, as '{data: 1}'"),
        (String(), "{data: ", "the values are no YAML: "),
    ],
)
def test_what_cannot_be_a_message_is_told(message: Any, values: str, told: str) -> None:
    with pytest.raises(RunError) as error:
        fill(message, mapping_of(values))
    assert str(error.value).startswith(told)


def test_long_values_are_shortened() -> None:
    scan = LaserScan(ranges=[1.0] * 5, header=Header(frame_id="a long name"))
    short = plain(scan, Shortening(length=3))
    assert short["ranges"] == [1.0, 1.0, 1.0, "..."]
    assert short["header"]["frame_id"] == "a l..."
    without = plain(scan, Shortening(no_arrays=True, no_texts=True))
    assert without["ranges"] == "<sequence type: float, length: 5>"
    assert without["header"]["frame_id"] == "<string length: <11>>"
    fixed = plain(PoseWithCovariance(), Shortening(no_arrays=True))
    assert fixed["covariance"] == "<array type: double[36]>"


def test_values_are_written_in_one_line() -> None:
    assert csv_text(Header(frame_id="a")) == "0,0,a\n"


def test_parts_of_messages_are_taken_by_their_paths() -> None:
    array = DiagnosticArray(status=[DiagnosticStatus(values=[KeyValue(key="a")])])
    assert field_of("status[0].values[-1].key")(array) == "a"
    for path, told in (
        ("statu", "did you mean status?"),
        ("status[3]", "there is no [3]"),
        ("a b", "no path"),
    ):
        with pytest.raises(RunError, match=told.replace("[", r"\[")):
            field_of(path)(array)


def test_a_filter_that_fails_is_told() -> None:
    assert passes("m.data == 'a'")(String(data="a"))
    assert not passes("m.data == 'a'")(String(data="b"))
    with pytest.raises(RunError, match="no expression of Python"):
        passes("m.data =")
    with pytest.raises(RunError, match="ZeroDivisionError"):
        passes("1 / 0")(String())

"""Definitions of interfaces: which are there, and their text."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.cli.interfaces.expanded import Comments, bare, expanded, type_in, without_comment
from orchestra.cli.interfaces.index import Interfaces
from orchestra.errors import RunError

if TYPE_CHECKING:
    from pathlib import Path

_OUTER = """\
# What it is

Inner[] parts  # all of them
other_msgs/Deep deep
string<=5 name "a # b"
uint8 KIND=1 # one
---
bool done
"""
_TEXTS = {
    "my_msgs/srv/Outer": _OUTER,
    "my_msgs/msg/Inner": "# a part\n\nfloat64 x 0 # how far\n",
    "other_msgs/msg/Deep": "my_msgs/msg/Inner[3] inner\n",
}


@pytest.fixture
def interfaces(tmp_path: Path) -> Interfaces:
    index = tmp_path / "share" / "ament_index" / "resource_index"
    for resource in ("packages", "rosidl_interfaces"):
        (index / resource).mkdir(parents=True)
    for package, lines in {
        "my_msgs": "msg/Inner.idl\nmsg/Inner.msg\nsrv/Outer.idl\nsrv/Outer.srv\n",
        "other_msgs": "msg/Deep.idl\nmsg/Deep.msg\n",
    }.items():
        (index / "packages" / package).write_text("")
        (index / "rosidl_interfaces" / package).write_text(lines)
    for name, text in _TEXTS.items():
        package, kind, local = name.split("/")
        path = tmp_path / "share" / package / kind / f"{local}.{kind}"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return Interfaces({"AMENT_PREFIX_PATH": str(tmp_path)})


def test_interfaces_are_listed_once_by_package_and_kind(interfaces: Interfaces) -> None:
    assert interfaces.of("my_msgs") == ["my_msgs/msg/Inner", "my_msgs/srv/Outer"]
    assert {"my_msgs", "tf2_msgs"} <= set(interfaces.packages())
    assert "other_msgs" not in interfaces.packages(("srv",))
    assert "my_msgs/srv/Outer" in interfaces.all(("srv",))


def test_fields_of_types_stand_one_tab_deeper_without_comments(interfaces: Interfaces) -> None:
    assert (
        expanded("my_msgs/srv/Outer", interfaces.text)
        == """\
# What it is

Inner[] parts  # all of them
	float64 x 0 #
other_msgs/Deep deep
	my_msgs/msg/Inner[3] inner
		float64 x 0 #
string<=5 name "a # b"
uint8 KIND=1 # one
---
bool done
"""
    )


def test_comments_are_shown_as_they_are_wanted(interfaces: Interfaces) -> None:
    none = expanded("my_msgs/srv/Outer", interfaces.text, Comments.NONE)
    assert none.startswith("Inner[] parts  #\n\tfloat64 x 0 #\n")
    assert 'string<=5 name "a #\nuint8 KIND=1 # one\n---\n' in none
    everything = expanded("my_msgs/srv/Outer", interfaces.text, Comments.ALL)
    assert "\t# a part\n\n\tfloat64 x 0 # how far\n" in everything


@pytest.mark.parametrize(
    ("line", "shown"),
    [
        ("# said", ""),
        ("#", "#"),
        ("# [m]", "# [m]"),
        ("    # said", "    # said"),
        ("float32 x   # how far [m]", "float32 x   #"),
        ("uint8 A = 1  # said", "uint8 A = 1  # said"),
        ("uint8<=3[] a", "uint8<=3[] a"),
    ],
)
def test_comments_are_left_out_as_the_ros_2_tools_leave_them_out(line: str, shown: str) -> None:
    assert bare(line) == shown


def test_a_definition_in_idl_is_shown_as_it_is() -> None:
    text = "module a {\n  module msg {\n  };\n};\n"
    assert expanded("a/msg/B", lambda _: text) == text


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("my_msgs/Inner", "'my_msgs/Inner' is not the full name of an interface"),
        ("my_msg/msg/Inner", "there is no package my_msg with interfaces; did you mean my_msgs?"),
        ("my_msgs/msg/Iner", "no such interface; did you mean my_msgs/msg/Inner?"),
    ],
)
def test_what_is_not_there_is_told(interfaces: Interfaces, name: str, told: str) -> None:
    with pytest.raises(RunError) as error:
        interfaces.text(name)
    assert told in str(error.value)


@pytest.mark.parametrize(
    ("field", "name"),
    [
        ("float64[36] a", None),
        ("string<=10[<=3] a", None),
        ("Vector3  linear", "p/msg/Vector3"),
        ("std_msgs/Header header", "std_msgs/msg/Header"),
        ("a_msgs/msg/B[<=2] b", "a_msgs/msg/B"),
        ("---", None),
        ("", None),
    ],
)
def test_types_with_fields_are_known(field: str, name: str | None) -> None:
    assert type_in(field, "p") == name


def test_a_hash_in_a_text_begins_no_comment() -> None:
    assert without_comment("string a 'b # c' # d") == "string a 'b # c' "
    assert without_comment("# it's") == ""

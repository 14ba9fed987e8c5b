"""Definitions are read as rosidl reads them, and what is wrong in them is told at its place."""

from __future__ import annotations

import warnings
from contextlib import redirect_stderr
from io import StringIO
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rosidl_adapter import convert_to_idl  # type: ignore[import-untyped]  # as every ROS package

from orchestra.ros.interfaces.reading import interface
from orchestra.ros.interfaces.reading.mistakes import DefinitionError, Place

_PRIMITIVES = [
    "bool",
    "byte",
    "char",
    "float32",
    "float64",
    "int8",
    "uint8",
    "int16",
    "uint16",
    "int64",
    "uint64",
]
_TEXTS = st.sampled_from(["a b", "it's", "wörld", "", "x=1", "comma, here", r"tab\t", r"back\\slash"])


@st.composite
def _values(draw: st.DrawFn, kind: str) -> str:
    if kind == "bool":
        return draw(st.sampled_from(["true", "False", "0", "1"]))
    if kind.startswith("float"):
        return draw(st.sampled_from(["1.5", "-2", "1e3", "-0.25e-3", "7."]))
    if "string" in kind:
        return f'"{draw(_TEXTS)}"'
    return draw(
        st.sampled_from(["0", "7", "0x1F"] if kind in ("byte", "char") or kind[0] == "u" else ["0", "-7"])
    )


@st.composite
def _field(draw: st.DrawFn, number: int) -> str:
    kind = draw(
        st.sampled_from([*_PRIMITIVES, "string", "wstring", "string<=40", "std_msgs/Header", "Other"])
    )
    array = draw(st.sampled_from(["", "", "[]", "[3]", "[<=5]"]))
    line = f"{kind}{array} field_{number}"
    if "/" in kind or kind == "Other" or draw(st.booleans()):
        return line + draw(st.sampled_from(["", "  # words", "\t"]))
    base = kind.partition("<")[0]
    if not array:
        return f"{line} {draw(_values(base))}"
    if "string" in base:
        return line
    return f"{line} [{', '.join(draw(_values(base)) for _ in range(3))}]"


@st.composite
def _definitions(draw: st.DrawFn) -> str:
    lines = [draw(_field(number)) for number in range(draw(st.integers(0, 8)))]
    for number in range(draw(st.integers(0, 4))):
        kind = draw(st.sampled_from([*_PRIMITIVES, "string", "wstring"]))
        lines.append(f"{kind} CONSTANT_{number}{draw(st.sampled_from(['=', ' = ']))}{draw(_values(kind))}")
    return "\n".join(["# what it is", "", *draw(st.permutations(lines)), ""])


@settings(max_examples=6)
@given(_definitions())
def test_a_definition_is_read_as_by_rosidl(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    folder = tmp_path_factory.mktemp("package")
    path = folder / "msg" / "Made.msg"
    path.parent.mkdir()
    path.write_text(text)
    assert _facts(interface.read("demo", path).content) == _facts(_by_rosidl(folder, Path("msg/Made.msg")))


@pytest.mark.parametrize(
    ("file", "text"),
    [
        ("srv/Ask.srv", "string question 'why?'\nint8 A=1\n---\nbool ok\nint8 B=2\n"),
        ("srv/Ask.srv", "---\n"),
        ("action/Go.action", "Other[2] a\n---\nwstring<=3[<=2] b\n---\nfloat32[] c\n"),
    ],
)
def test_the_parts_of_services_and_actions_too(tmp_path: Path, file: str, text: str) -> None:
    path = tmp_path / file
    path.parent.mkdir()
    path.write_text(text)
    assert _facts(interface.read("demo", path).content) == _facts(_by_rosidl(tmp_path, Path(file)))


def _by_rosidl(folder: Path, file: Path) -> Any:
    """Go the way of rosidl: to IDL, and then by its parser."""
    with redirect_stderr(StringIO()), warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        convert_to_idl(folder, "demo", file, folder)
        return interface.read("demo", folder / file.with_suffix(".idl")).content


def _facts(content: Any) -> Any:
    """Return all that a definition says, to be compared."""
    names = ("goal", "result", "feedback", "request_message", "response_message")
    if not hasattr(content, "structure"):
        parts = [getattr(content, name) for name in names if hasattr(content, name)]
        return content.namespaced_type.namespaced_name(), [_facts(part) for part in parts]
    members = [
        (
            member.name,
            _shape(member.type),
            [note.value for note in member.annotations if note.name == "default"],
        )
        for member in content.structure.members
    ]
    constants = sorted((found.name, _shape(found.type), found.value) for found in content.constants)
    return content.structure.namespaced_type.namespaced_name(), members, constants


def _shape(kind: Any) -> Any:
    found = {name: getattr(kind, name) for base in type(kind).__mro__ for name in _slots(base)}
    return type(kind).__name__, {
        key: _shape(value) if key == "value_type" else value for key, value in found.items()
    }


def _slots(kind: Any) -> list[str]:
    slots = getattr(kind, "__slots__", ())
    return [slots] if isinstance(slots, str) else list(slots)


@pytest.mark.parametrize(
    ("text", "place", "told"),
    [
        ("flaot64 value", (1, 1, 8), "'flaot64' is not a type"),
        ("# words\n\nint32 Value", (3, 7, 12), "'Value' is not the name of a field"),
        ("int32 class", (1, 7, 12), "'class' is a word of Python"),
        ("int32 a__b", (1, 7, 11), "'a__b' is not the name of a field"),
        ("int32", (1, 1, 6), "a type and a name"),
        ("  int32 a", (1, 1, 3), "begins with its type"),
        ("uint8 a 256", (1, 9, 12), "value '256' can not be converted to type 'uint8'"),
        ("int32 a\nint32 a", (2, 7, 8), "there is a field 'a' already"),
        ("int8 A=1\nint8 A=2", (2, 6, 7), "there is a constant 'A' already"),
        ("int8 a=1", (1, 6, 7), "'a' is not the name of a constant"),
        ("int8 A=x", (1, 8, 9), "value 'x' can not be converted to type 'int8'"),
        ("int8[0] a", (1, 1, 8), "the size of the array 'int8[0]' is a whole number above 0"),
        ("int8[<=x] a", (1, 1, 10), "is a whole number above 0, with '<=' before it"),
        ("int8] a", (1, 1, 6), "'int8]' is not a type"),
        ("string<=0 a", (1, 1, 10), "the bound of the string 'string<=0' is a whole number above 0"),
        ("string<=2 a 'abc'", (1, 13, 18), "must not exceed the maximum length of 2"),
        ("int8[2] a [1]", (1, 11, 14), "array must have exactly 2 elements, not 1"),
        ("time stamp", (1, 1, 5), "ROS 2 has builtin_interfaces/Time for it"),
        ("std_msgs/Header h 1", (1, 19, 20), "has no default value"),
        ("std_msgs/Header H=1", (1, 1, 16), "a constant has a primitive type"),
        ("float32 a nan", (1, 11, 14), "a value is a finite number"),
        ("Std/Header a", (1, 1, 11), "'Std/Header' is not a type"),
        ("a/b/c/D x", (1, 1, 8), "is not a type"),
    ],
)
def test_a_mistake_is_told_at_its_place(
    tmp_path: Path, text: str, place: tuple[int, int, int], told: str
) -> None:
    path = tmp_path / "Made.msg"
    path.write_text(text)
    with pytest.raises(DefinitionError) as caught:
        interface.read("demo", path, "msg/Made.msg")
    assert caught.value.place == place
    assert told in caught.value.message
    assert str(caught.value).startswith(f"msg/Made.msg:{place[0]}:{place[1]}: ")


@pytest.mark.parametrize(
    ("file", "text", "told", "line"),
    [
        ("Ask.srv", "int8 a\n", "there is one line '---'", 1),
        ("Ask.srv", "---\n---\n", "there is one line '---'", 2),
        ("Go.action", "---\nint8 a\n", "there are two lines '---'", 2),
        ("Go.action", "---\n---\n---\n", "there are two lines '---'", 3),
        ("Ask.srv", "int8 a\n---\nint8 B\n", "'B' is not the name of a field", 3),
        ("lower.msg", "int8 a\n", "'lower' is not the name of a type", None),
        ("Bad.idl", "module demo {\n struct 5", "Unexpected|No terminal", 2),
    ],
)
def test_a_file_as_a_whole_may_be_wrong(
    tmp_path: Path, file: str, text: str, told: str, line: int | None
) -> None:
    (tmp_path / "srv").mkdir()
    (tmp_path / "srv" / file).write_text(text)
    with pytest.raises(DefinitionError, match=told) as caught:
        interface.read("demo", tmp_path / "srv" / file)
    assert (caught.value.place.line if caught.value.place else None) == line


def test_a_file_that_cannot_be_read_is_told(tmp_path: Path) -> None:
    (tmp_path / "Latin.msg").write_bytes(b"# \xff\nint8 a\n")
    for name in ("Latin.msg", "Missing.msg"):
        with pytest.raises(DefinitionError, match="it cannot be read"):
            interface.read("demo", tmp_path / name)


@given(st.text(st.sampled_from("int8[]<=3 aA_/='\"\n#-\tstring"), max_size=60))
def test_any_text_is_a_definition_or_refused_at_a_place(
    tmp_path_factory: pytest.TempPathFactory, text: str
) -> None:
    path = tmp_path_factory.getbasetemp() / "Any.msg"
    path.write_text(text)
    place = None
    try:
        interface.read("demo", path)
    except DefinitionError as error:
        place = error.place or Place(0, 0, 0)
    if place is not None:
        line = text.splitlines()[place.line - 1]
        assert 1 <= place.column < place.end_column <= max(len(line), 1) + 1

"""Whatever stands in a file that should declare something, it is told, and in time."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.declared.interfaces.files import interface_of
from orchestra.declared.reading import read_file
from orchestra.errors import Problems
from orchestra.location import Location, point

if TYPE_CHECKING:
    from pathlib import Path

_PATIENT = settings(
    deadline=None, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture]
)
_AT = Location(point("a.launch.yaml"))
_VALUES: dict[str, Any] = {"x": 1, "a.b": 2.5, "c": ("u", "v"), "joints": ("j",), "j.p": True}

_words = st.sampled_from(
    [
        *(
            "type",
            "properties",
            "required",
            "items",
            "enum",
            "minimum",
            "additionalProperties",
            "$ref",
            "anyOf",
        ),
        *(
            "patternProperties",
            "$schema",
            "default_value",
            "validation",
            "bounds<>",
            "one_of<>",
            "__map_joints",
        ),
        *(
            "x",
            "joints",
            "publishers",
            "subscriptions",
            "name",
            "qos",
            "deadline",
            "x-ros-type",
            "x-ros-step",
        ),
    ]
)
_leaves = (
    st.none()
    | st.booleans()
    | st.integers(-3, 3)
    | st.floats(allow_nan=False, allow_infinity=False, width=16)
    | st.sampled_from(
        ["object", "array", "integer", "double", "string_array", "none", "#", "#/x", "[", "a/B", ""]
    )
)
_trees = st.recursive(
    _leaves,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(_words, inner, max_size=4),
    max_leaves=12,
)


def _read(path: Path) -> None:
    problems = Problems()
    read = read_file(str(path), _AT, problems)
    if read is not None:
        list(read.faults(_VALUES))
        list(read.faults({}))
    else:
        assert problems.errors


@_PATIENT
@given(st.dictionaries(_words, _trees, max_size=4) | _trees)
def test_any_tree(tmp_path: Path, tree: Any) -> None:
    for name, text in (("s.json", json.dumps(tree)), ("s.yaml", yaml.safe_dump(tree))):
        (tmp_path / name).write_text(text, "utf-8")
        _read(tmp_path / name)


@_PATIENT
@given(st.text(max_size=40) | st.text("{}[]:,-&*!|>'\"#\n abx", max_size=40))
def test_any_text(tmp_path: Path, text: str) -> None:
    for name in ("s.json", "s.yaml"):
        (tmp_path / name).write_bytes(text.encode("utf-8", "surrogatepass"))
        _read(tmp_path / name)


@_PATIENT
@given(st.dictionaries(_words, _trees, max_size=4) | _trees)
def test_any_interface(tmp_path: Path, tree: Any) -> None:
    (tmp_path / "params").mkdir(exist_ok=True)
    (tmp_path / "params" / "talker.interface.yaml").write_text(yaml.safe_dump(tree), "utf-8")
    interface_of(str(tmp_path), "talker", _AT, Problems())


@_PATIENT
@given(st.text("<>/=\"' abinterfacnodtpqs&;", max_size=60))
def test_any_nodl(tmp_path: Path, text: str) -> None:
    (tmp_path / "a.nodl.xml").write_text(f"<interface>{text}</interface>", "utf-8")
    interface_of(str(tmp_path), "talker", _AT, Problems())


_BOMB = "a: &a [x, x, x, x, x, x, x, x, x]\n" + "".join(
    f"{name}: &{name} [{', '.join([f'*{before}'] * 9)}]\n"
    for before, name in zip("abcdefgh", "bcdefghi", strict=True)
)


@pytest.mark.parametrize(
    "text",
    [
        "a: &a {b: *a}",
        "a: &a [*a]",
        _BOMB,
        "[" * 5000,
        '{"a":' * 5000,
        "a: 2001-13-45",
        "a: !!python/object:os.system {}",
        "\x00",
        "{1: {type: int}}",
        '{"type": "object", "patternProperties": {"[": {}}}',
        '{"type": "object", "properties": {"x": {"type": "string", "pattern": "("}}}',
    ],
)
def test_what_nobody_writes_is_told(tmp_path: Path, text: str) -> None:
    for name in ("s.yaml", "s.json"):
        path = tmp_path / name
        path.write_text(text, "utf-8")
        problems = Problems()
        read = read_file(str(path), _AT, problems)
        assert read is not None or [problem for problem in problems if problem.span is not None]


@pytest.mark.parametrize(
    "schema",
    [
        {"type": "object", "allOf": [{"$ref": "#"}, {"$ref": "#"}], "properties": {"x": {"type": "string"}}},
        {
            "type": "object",
            "minProperties": 0,
            "properties": {name: {"$ref": "#"} for name in "abcdefghijklm"},
            "additionalProperties": False,
        },
    ],
)
def test_a_schema_that_holds_itself_comes_to_an_end(tmp_path: Path, schema: dict[str, Any]) -> None:
    (tmp_path / "s.json").write_text(json.dumps(schema), "utf-8")
    problems = Problems()
    read = read_file(str(tmp_path / "s.json"), _AT, problems)
    assert read is not None
    assert list(read.faults({"x": 1, "a.b.c": 1, "z.y": 2}))


def test_a_folder_and_a_wrong_encoding_are_told(tmp_path: Path) -> None:
    (tmp_path / "latin.yaml").write_bytes(b"a: \xe4")
    for name in ("latin.yaml", ".", "nowhere.json"):
        problems = Problems()
        assert read_file(str(tmp_path / name), _AT, problems) is None
        assert len(problems.errors) == 1

"""Settings files: what they say, and what is wrong with them, in its place."""

from __future__ import annotations

import tomllib
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.errors import Code, Problems
from orchestra.settings.find import Finder
from orchestra.settings.read import read
from orchestra.settings.toml_places import places

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def _problems(
    folder: Path, text: str, name: str = "orchestra.toml"
) -> list[tuple[str, str, int, int, int, str | None]]:
    (folder / name).write_text(text)
    problems = Problems()
    read(str(folder / name), problems)
    return [
        (item.code, item.span.file, item.span.line, item.span.column, item.span.end_column, item.suggestion)
        for item in problems
        if item.span is not None
    ]


@pytest.mark.parametrize(
    ("text", "code", "place", "suggestion"),
    [
        ("strict = true\nstrikt = 1\n", Code.UNKNOWN_KEY, (2, 1, 7), "strict"),
        ("strict = 'yes'\n", Code.WRONG_TYPE, (1, 10, 15), None),
        ("[severity]\nORC013 = 'of'\n", Code.BAD_VALUE, (2, 11, 13), "off"),
        ("[severity]\nORC0133 = 'off'\n", Code.UNKNOWN_KEY, (2, 1, 8), "ORC013"),
        ("severity.ORC013 = 3\n", Code.WRONG_TYPE, (1, 19, 20), None),
        ("severity = {ORC013 = 'off', orc004 = 'off'}\n", Code.UNKNOWN_KEY, (1, 29, 35), "ORC004"),
        ("exclude = 'x'\n", Code.WRONG_TYPE, (1, 11, 14), None),
        ("exclude = ['x', 3]\n", Code.WRONG_TYPE, (1, 17, 18), None),
        ("[[overrides]]\nfiles = ['x']\n", Code.MISSING_KEY, (1, 1, 14), None),
        (
            "[[overrides]]\nfiles = ['x']\nseverity = {}\nsevere = 1\n",
            Code.UNKNOWN_KEY,
            (4, 1, 7),
            "severity",
        ),
        ("strict = \n", Code.SYNTAX, (1, 10, 10), None),
        ("a = 1\na = 2\n", Code.SYNTAX, (2, 6, 6), None),
        ("[severity\n", Code.SYNTAX, (1, 10, 10), None),
    ],
)
def test_a_mistake_is_one_problem_in_its_place(
    folder: Path, text: str, code: Code, place: tuple[int, int, int], suggestion: str | None
) -> None:
    assert _problems(folder, text) == [(code, "orchestra.toml", *place, suggestion)]


def test_a_mistake_in_a_shared_file(folder: Path) -> None:
    text = "[project]\nname = 'x'\n\n[tool.orchestra]\nstrct = true\n"
    assert _problems(folder, text, "pyproject.toml") == [
        (Code.UNKNOWN_KEY, "pyproject.toml", 5, 1, 6, "strict")
    ]


def test_other_tables_of_a_shared_file_are_nobodys_business(folder: Path) -> None:
    assert _problems(folder, "[tool.ruff]\nstrikt = 1\n", "pyproject.toml") == []


def test_the_nearest_file_counts_and_our_own_before_the_shared_one(folder: Path) -> None:
    inner = folder / "a/b"
    inner.mkdir(parents=True)
    (folder / "orchestra.toml").write_text("strict = true\n")
    (folder / "a/pyproject.toml").write_text("[tool.black]\n")
    finder = Finder(Problems())
    found = finder.settings(str(inner / "x.yaml"))
    assert found is not None
    assert (found.strict, found.folder) == (True, str(folder))
    (folder / "a/pyproject.toml").write_text("[tool.orchestra]\nexclude = ['x']\n")
    (folder / "a/orchestra.toml").write_text("exclude = ['y']\n")
    found = Finder(Problems()).settings(str(inner / "x.yaml"))
    assert found is not None
    assert (found.strict, found.exclude) == (False, ("y",))


_VALUES: st.SearchStrategy[Any] = st.recursive(
    st.one_of(
        st.integers(), st.booleans(), st.text(st.characters(codec="utf-8", exclude_categories=["C", "Z"]))
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(st.text("ab-_ .\"'", max_size=4), inner, max_size=3)
    ),
    max_leaves=12,
)


def _toml(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, list):
        return "[" + ",\n # ] }\n".join(map(_toml, value)) + "]"
    return "{" + ", ".join(f"{_toml(key)} = {_toml(item)}" for key, item in value.items()) + "}"


@given(content=st.dictionaries(st.text("ab-_ .\"'", max_size=4), _VALUES, max_size=4))
def test_every_value_stands_where_it_is_said_to_stand(content: dict[str, Any]) -> None:
    text = "# first\n" + "".join(f"{_toml(key)} = {_toml(value)} # x\n" for key, value in content.items())
    lines = text.split("\n")
    for way, place in places(text, "f").items():
        value: Any = content
        for step in way:
            value = value[step]
        span = place.value
        written = "\n".join(lines[span.line - 1 : span.end_line])
        cut = len(lines[span.end_line - 1]) - span.end_column + 1
        assert tomllib.loads(f"x = {written[span.column - 1 : len(written) - cut]}")["x"] == value

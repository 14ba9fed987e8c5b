from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.errors import Problems
from orchestra.location import Location, point
from orchestra.resolve.rcl.effective import Setting, effective
from orchestra.resolve.rcl.files import read_parameter_file
from orchestra.resolve.rcl.overrides import read_override
from orchestra.resolve.rcl.sections import Section, entry

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

_AT = Location(point("command line"))
_PROBES = [
    json.loads(line)
    for line in Path(__file__).parents[1].joinpath("data/rcl-probes.jsonl").read_text("utf-8").splitlines()
]
_NOT_FINITE = {"NaN": float("nan"), "Infinity": float("inf"), "-Infinity": float("-inf")}


def _override(text: str) -> Section:
    override = read_override(text)
    return Section(override.pattern, (entry(override.name, override.value, _AT),), _AT)


def _sections(files: Iterable[str], overrides: Iterable[str] = ()) -> list[Section]:
    """Read files and then overrides. Raises `ValueError` where rcl would refuse any of them."""
    problems = Problems()
    sections = [
        section
        for number, text in enumerate(files, 1)
        for section in read_parameter_file(text, f"{number}.yaml", problems)
    ]
    if problems.errors:
        raise ValueError(problems.errors[0].message)
    return sections + [_override(text) for text in overrides]


def _measured(parameter: dict[str, Any]) -> object:
    value = parameter["value"]
    if isinstance(value, list):
        return tuple(value)
    return _NOT_FINITE.get(value, value) if parameter["type"] == "DOUBLE" else value


@pytest.mark.conforms("4.6.5 order of patterns")
@pytest.mark.parametrize(
    "probe",
    [p for p in _PROBES if p["k"] in ("params", "scalar", "argument")],
    ids=lambda p: f"{p['k']}: {p['label']}",
)
def test_a_node_has_what_was_measured(probe: dict[str, Any]) -> None:
    try:
        found = effective(_sections(probe["files"], probe["args"][1::2]), "/ns/n")
    except ValueError:
        assert "error" in probe
        return
    if "error" in probe:
        assert [setting for setting in found.values() if setting.value is None]
    else:
        expected = {name: _measured(parameter) for name, parameter in probe["parameters"].items()}
        assert repr({name: setting.value for name, setting in found.items()}) == repr(expected)


@pytest.mark.parametrize("probe", [p for p in _PROBES if p["k"] == "name" and p["args"][0] == "-p"], ids=str)
def test_overrides_in_probes_of_names(probe: dict[str, Any]) -> None:
    if "error" in probe:
        with pytest.raises(ValueError, match=":="):
            _override(probe["args"][1])
    else:
        found = effective(_sections(probe["files"], probe["args"][1::2]), "/ns/n")
        assert {name: setting.value for name, setting in found.items()} == {"x": 9}


def _file(*sections: tuple[str, str]) -> str:
    return "".join(f"{pattern}:\n  ros__parameters: {{{values}}}\n" for pattern, values in sections)


def _setting(*files: str, name: str = "a") -> Setting:
    return effective(_sections(files), "/ns/n")[name]


def test_all_that_was_written_is_kept_in_order_with_its_places() -> None:
    setting = _setting(_file(("/**", "a: 1"), ("/ns/n", "a: 2")), _file(("/**", "a: 3"), ("/other", "a: 4")))
    assert [(item.pattern, item.value, str(item.location), item.won) for item in setting.written] == [
        ("/**", 1, "1.yaml:2:24", False),
        ("/ns/n", 2, "1.yaml:4:24", True),
        ("/**", 3, "2.yaml:2:24", False),
    ]


@pytest.mark.conforms("D68")
def test_where_the_last_does_not_win_the_overruled_is_named() -> None:
    setting = _setting(_file(("/**", "a: 1"), ("/ns/n", "a: 2"), ("/**", "a: 3")))
    assert setting.value == 2
    assert setting.overruled is not None
    assert setting.overruled.value == 3
    assert setting.rule == "'/ns/n' is the matching pattern that appears last for the first time, after '/**'"


@pytest.mark.parametrize(
    ("sections", "value", "rule"),
    [
        ([("/**", "a: 1")], 1, "set for '/**'"),
        ([("/**", "a: 1"), ("/**", "a: 2")], 2, "the last value for '/**'"),
        (
            [("/ns/n", "a: 1"), ("/**", "a: 2")],
            2,
            "'/**' is the matching pattern that appears last for the first time, after '/ns/n'",
        ),
    ],
)
def test_where_the_last_wins_nothing_is_overruled(
    sections: list[tuple[str, str]], value: int, rule: str
) -> None:
    setting = _setting(_file(*sections))
    assert (setting.value, setting.rule, setting.overruled) == (value, rule, None)


def test_the_same_value_again_overrules_nothing() -> None:
    assert _setting(_file(("/**", "a: 1"), ("/ns/n", "a: 3"), ("/**", "a: 3"))).overruled is None


def test_an_integer_stays_beside_a_later_text_of_the_same_pattern() -> None:
    setting = _setting(_file(("/**", "a: 1"), ("/**", "a: text")))
    assert setting.value == 1
    assert setting.overruled is not None
    assert setting.overruled.value == "text"
    assert setting.rule == "of values of several types for '/**', rcl takes the integer"


def test_a_pattern_written_in_two_ways_counts_twice() -> None:
    assert _setting(_file(("/ns/n", "a: 1"), ("/**", "a: 2"), ("ns/n", "a: 3"))).value == 3


@pytest.mark.conforms("4.6.4 null")
@pytest.mark.parametrize("value", ["[]", "{}"])
def test_a_parameter_without_a_type_is_none(value: str) -> None:
    setting = _setting(_file(("/ns/n", f"a: {value}")))
    assert (setting.value, setting.rule) == (None, "'/ns/n' gives it no value")
    assert [str(item.location) for item in setting.written] == ["1.yaml:2:24"]


def test_a_group_of_the_same_name_is_no_value() -> None:
    setting = _setting(_file(("/**", "a: 1"), ("/ns/n", "a: {b: 2}")))
    assert setting.value == 1
    assert [item.value for item in setting.written] == [1]
    assert setting.overruled is None


_PATTERNS = st.sampled_from(["/**", "/ns/n", "ns/n", "/*/n", "/**/n", "/ns/*", "n", "/*"])
_VALUES = st.sampled_from(["1", "2", "text", "[1]", "true", "1.5", "[]", "{b: 3}"])
_CONTENTS = st.lists(st.tuples(st.sampled_from(["a", "a.b", "c"]), _VALUES), min_size=1, max_size=2).map(
    lambda pairs: ", ".join(f"{name}: {value}" for name, value in pairs)
)
_FILES = st.lists(st.tuples(_PATTERNS, _CONTENTS), min_size=1, max_size=4).map(
    lambda sections: _file(*sections)
)
_OVERRIDES = st.builds(
    "{}:={}".format, st.sampled_from(["a", "a.b", "n:a"]), st.sampled_from(["7", "x", "[2]"])
)


@pytest.mark.conforms("4.6.5 order of patterns", "4.5 precedence of parameters")
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=150,
)
@given(files=st.lists(_FILES, max_size=3), overrides=st.lists(_OVERRIDES, max_size=2))
def test_values_win_as_in_the_real_node(
    ask_rcl: Callable[..., Any], files: list[str], overrides: list[str]
) -> None:
    words: list[str | list[str]] = ["--ros-args"]
    for text in files:
        words += ["--params-file", [text]]
    for override in overrides:
        words += ["-p", override]
    answer = ask_rcl("node", arguments=words)
    try:
        found = effective(_sections(files, overrides), "/ns/n")
    except ValueError:
        assert "error" in answer
        return
    values = {name: setting.value for name, setting in found.items()}
    plain = {name: list(value) if isinstance(value, tuple) else value for name, value in values.items()}
    assert plain == answer["parameters"]
    for setting in found.values():
        winners = [item.value for item in setting.written if item.won]
        assert winners == ([] if setting.value is None else [setting.value])

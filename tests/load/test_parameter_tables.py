"""Every row of the tables of parameter values: what is written, in XML and in YAML, and what the node gets (2.5, 2.6)."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Problems, Severity
from orchestra.pipeline import collect, inputs_from
from tests.load.written import attribute

if TYPE_CHECKING:
    from pathlib import Path

_ERROR = object()
_LINES = {
    "xml": '<launch><let name="x" value="7"/><let name="l" value="[1, 2]"/>'
    '<node exec="e" name="n"><param name="p" {}/></node></launch>',
    "yaml": "launch:\n- let: {{name: x, value: 7}}\n- let: {{name: l, value: '[1, 2]'}}\n"
    "- node:\n    exec: e\n    name: n\n    param:\n    - name: p\n{}\n",
}


def _value(folder: Path, language: str, **keys: str) -> Any:
    """Return the value that a node gets for the keys of a parameter as they are written."""
    if language == "xml":
        written = " ".join(f'{key}="{attribute(text)}"' for key, text in keys.items())
    else:
        written = "\n".join(f"      {key}: {text}" for key, text in keys.items())
    path = folder / f"a.launch.{language}"
    path.write_text(_LINES[language].format(written), "utf-8")
    problems = Problems()
    plan = collect(str(path), inputs_from([], environment={}), problems)
    errors = [problem for problem in problems if problem.severity is Severity.ERROR]
    assert len(errors) <= 1
    if errors:
        return _ERROR
    assert plan is not None
    return plan.processes[0].parameters["p"]


# As written -> the value; where XML and YAML differ, both.
PLAIN: dict[str, Any] = {
    "1": 1,
    "0x10": 16,
    "010": 8,
    "12:30": 750,
    "1_000": 1000,
    "1.5": 1.5,
    ".5": 0.5,
    ".inf": math.inf,
    "1e3": 1000.0,  # text to upstream, which rcl types again
    "1e-6": 1e-6,
    "inf": math.inf,
    "y": True,  # text to upstream as well
    "n": False,
    **dict.fromkeys(("true", "True", "TRUE", "yes", "on"), True),
    **dict.fromkeys(("false", "no", "off"), False),
    "abc": "abc",
    "a b": "a b",
    "'5'": "5",
    "'abc'": "abc",
    "null": _ERROR,
    "~": _ERROR,
    "2024-01-01": _ERROR,
    "[1, 2]": (1, 2),
    "[a, b]": ("a", "b"),
    "[1, a]": _ERROR,
    "[true, 1]": _ERROR,
    "[[1], [2]]": _ERROR,
    "[]": _ERROR,
}
ONLY_XML: dict[str, Any] = {
    "": "",
    "- 1": (1,),
    "{a: 1}": _ERROR,
    "[1, 2.5]": _ERROR,
    '"5"': "5",
    "it's": "it's",
    "[$(var x), 2]": (7, 2),
}
ONLY_YAML: dict[str, Any] = {
    "''": "",
    '"5"': "5",
    "'true'": "true",
    "'1e3'": "1e3",
    "'y'": "y",
    "'[1, 2]'": "[1, 2]",
    "{a: 1}": _ERROR,
    "['$(var x)', 1]": (7, 1),
    "['$(var x)', a]": _ERROR,
    "['1', '2']": ("1", "2"),
}
SUBSTITUTED: dict[str, Any] = {
    "$(var x)": 7,
    "x$(var x)": "x7",
    "$(var none 'yes')": True,
    "$(var l)": (1, 2),
    "$(var none '')": "",
}


def _rows(*tables: dict[str, Any]) -> Any:
    rows = [(text, value) for table in tables for text, value in table.items()]
    return pytest.mark.parametrize(("text", "expected"), rows)


@pytest.mark.conforms(
    "2.5 value",
    "2.5 integers",
    "2.5 floats",
    "2.5 floats without a point",
    "2.5 booleans",
    "2.5 texts",
    "2.5 quoted",
    "2.5 other values",
    "2.5 lists",
    "2.5 mixed lists",
    "2.5 substitutions",
    "2.5 substitutions in lists",
    "2.6 no type",
    "2.5 one letter",
)
@_rows(PLAIN, ONLY_XML, SUBSTITUTED)
def test_the_text_of_an_attribute(text: str, expected: Any, tmp_path: Path) -> None:
    _same(_value(tmp_path, "xml", value=text), expected)


@pytest.mark.conforms(
    "2.5 value",
    "2.5 integers",
    "2.5 floats",
    "2.5 floats without a point",
    "2.5 booleans",
    "2.5 texts",
    "2.5 quoted",
    "2.5 other values",
    "2.5 lists",
    "2.5 mixed lists",
    "2.5 substitutions in lists",
    "2.5 one letter",
    "D15",
)
@_rows(PLAIN, ONLY_YAML)
def test_a_native_value(text: str, expected: Any, tmp_path: Path) -> None:
    _same(_value(tmp_path, "yaml", value=text), expected)


@pytest.mark.conforms("2.5 substitutions")
@_rows(SUBSTITUTED)
def test_a_substitution_in_quotes(text: str, expected: Any, tmp_path: Path) -> None:
    _same(_value(tmp_path, "yaml", value=f'"{text}"'), expected)


# 2.5 with a type, 2.6: type, text -> value.
TYPED: dict[tuple[str, str], Any] = {
    ("str", "1"): "1",
    ("str", "true"): "true",
    ("str", "$(var x)"): "7",
    ("int", "1"): 1,
    ("int", " 1 "): 1,
    ("int", "$(var x)"): 7,
    ("int", "0x10"): _ERROR,
    ("int", "1.5"): _ERROR,
    ("float", "1"): 1.0,
    ("float", "1e3"): 1000.0,
    ("float", "inf"): math.inf,
    ("float", "a"): _ERROR,
    **{
        ("bool", text): True
        for text in ("1", "true", "True", "TRUE", "yes", "Yes", "YES", "on", "On", "ON", " true")
    },
    **{("bool", text): False for text in ("0", "false", "no", "off", "OFF")},
    **{("bool", text): _ERROR for text in ("y", "n", "2", "")},
    ("list_of_int", "[1, 2]"): (1, 2),
    ("list_of_int", "[1, a]"): _ERROR,
    ("list_of_int", "1,2"): _ERROR,
    ("list_of_float", "[1.5, 2.5]"): (1.5, 2.5),
    ("list_of_bool", "[true, off]"): (True, False),
    ("list_of_str", "[a, b]"): ("a", "b"),
    ("list_of_str", "[1, 2]"): _ERROR,
    ("list_of_str", "['1', '2']"): ("1", "2"),
    ("yaml", "0x10"): 16,
    ("yaml", "[1, 2]"): (1, 2),
}


# What is quoted in YAML is a text, unless it gets another type than "yaml".
_TYPED_IN = [
    (language, *key) for language in sorted(_LINES) for key in TYPED if (language, key[0]) != ("yaml", "yaml")
]


@pytest.mark.conforms(
    "2.5 type", "2.5 with a type", "2.6 str", "2.6 int", "2.6 float", "2.6 bool", "2.6 lists", "D65"
)
@pytest.mark.parametrize(("language", "type_word", "text"), _TYPED_IN)
def test_a_type_reads_the_text(language: str, type_word: str, text: str, tmp_path: Path) -> None:
    written = text if language == "xml" else "'" + text.replace("'", "''") + "'"
    _same(_value(tmp_path, language, value=written, type=type_word), TYPED[type_word, text])


SEPARATED: dict[tuple[str, str], Any] = {
    ("1, 2", ", "): (1, 2),
    ("1, 2", ","): (1, 2),  # YAML reads " 2" as 2
    ("a b", " "): ("a", "b"),
    ("1", ","): (1,),
    ("1;x", ";"): _ERROR,
    ("$(var x),2", ","): (7, 2),
    ("'1','2'", ","): ("1", "2"),
}


@pytest.mark.conforms("2.5 lists", "2.2 list-valued attribute")
@pytest.mark.parametrize(("text", "separator"), SEPARATED)
def test_a_separator_makes_a_list(text: str, separator: str, tmp_path: Path) -> None:
    _same(_value(tmp_path, "xml", value=text, **{"value-sep": separator}), SEPARATED[text, separator])


@pytest.mark.conforms("2.5 with a type")
@pytest.mark.parametrize(
    ("type_word", "expected"),
    [
        ("list_of_float", (1.0, 2.0)),
        ("list_of_str", ("1", "2")),
        ("list_of_int", (1, 2)),
        ("list_of_bool", _ERROR),
    ],
)
def test_items_after_a_separator_have_the_type_of_the_list(
    type_word: str, expected: Any, tmp_path: Path
) -> None:
    _same(_value(tmp_path, "xml", value="1,2", type=type_word, **{"value-sep": ","}), expected)


def _same(value: Any, expected: Any) -> None:
    assert value == expected
    assert type(value) is type(expected)

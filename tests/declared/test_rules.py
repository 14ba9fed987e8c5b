"""Every validation of generate_parameter_library, by what it takes and what it refuses."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
import yaml

from orchestra.declared.documents import Document
from orchestra.declared.generated import read_definition
from orchestra.declared.generated_rules import RULES
from orchestra.declared.kinds import TYPES
from orchestra.errors import Code, Problems

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.declared.model import Fault
    from orchestra.values import ParameterValue


def faults(definition: str, **values: ParameterValue) -> list[Fault]:
    problems = Problems()
    found = read_definition(Document("d.yaml", definition, yaml.safe_load(definition)), problems)
    assert list(problems) == []
    assert found is not None
    return list(found.faults(values))


def _told(kind: str, validation: str, value: ParameterValue) -> list[str]:
    definition = f"demo: {{x: {{type: {kind}, validation: {{{validation}}}}}}}"
    return [fault.told for fault in faults(definition, x=value)]


# Function, type, arguments, values that are taken, values that are refused, and what is said of the first of these.
ROWS: list[tuple[str, str, str, list[ParameterValue], list[ParameterValue], str]] = [
    ("bounds", "double", "[0.0, 5.0]", [0.0, 2.5, 5.0], [-0.1, 5.1], "must be from 0.0 to 5.0, not -0.1"),
    ("bounds", "int", "[-3, 3]", [-3, 0, 3], [4, -4], "must be from -3 to 3, not 4"),
    ("lower_bounds", "int", "[2]", [2, 9], [1], "must be at least 2, not 1"),
    ("upper_bounds", "int", "[2]", [2, -9], [3], "must be at most 2, not 3"),
    ("gt", "double", "[0.0]", [0.1], [0.0, -1.0], "must be more than 0.0, not 0.0"),
    ("gt_eq", "double", "0.5", [0.5, 9.0], [0.4], "must be at least 0.5, not 0.4"),
    ("lt", "int", "[15]", [14], [15], "must be less than 15, not 15"),
    ("lt_eq", "int", "[15]", [15], [16], "must be at most 15, not 16"),
    ("one_of", "string", "[[spline, linear]]", ["linear"], ["linaer", ""], "must be one of 'spline', 'linear', not 'linaer'"),
    ("one_of", "int", "[[0, 1, -1]]", [-1], [2], "must be one of 0, 1, -1, not 2"),
    ("one_of", "double", "[[0, 0.5]]", [0.0, 0.5], [0.25], "must be one of 0.0, 0.5, not 0.25"),
    ("one_of", "bool", "[[true]]", [True], [False], "must be true, not false"),
    ("not_empty", "string", "[]", ["a"], [""], "must not be empty"),
    ("not_empty", "string_array", "null", [("a",)], [()], "must not be empty"),
    ("fixed_size", "double_array", "3", [(1.0, 2.0, 3.0)], [(1.0,)], "must have 3 items, not 1"),
    ("fixed_size", "string", "[2]", ["ab"], ["abc"], "must have 2 characters, not 3"),
    ("size_gt", "string_array", "[0]", [("a",)], [()], "must not be empty"),
    ("size_gt", "string", "[2]", ["abc"], ["ab"], "must have at least 3 characters, not 2"),
    ("size_lt", "int_array", "[3]", [(1, 2)], [(1, 2, 3)], "must have at most 2 items, not 3"),
    ("size_lt", "string", "[3]", ["ab"], ["abc", "aé"], "must have at most 2 characters, not 3"),
    ("unique", "string_array", "null", [("a", "b")], [("a", "b", "a")], "must not have an item twice, as 'a'"),
    ("subset_of", "string_array", "[[a, b]]", [("a",), ("b", "a")], [("a", "c")], "must be one of 'a', 'b', not 'c'"),
    ("element_bounds", "double_array", "[0.0, 1.0]", [(0.0, 1.0)], [(0.5, 1.5)], "must be from 0.0 to 1.0, not 1.5"),
    ("lower_element_bounds", "int_array", "[0]", [(0, 5)], [(1, -1)], "must be at least 0, not -1"),
    ("upper_element_bounds", "int_array", "[5]", [(0, 5)], [(6,)], "must be at most 5, not 6"),
]  # fmt: skip


@pytest.mark.parametrize("suffix", ["<>", ""])
@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row[0]}-{row[1]}")
def test_validations(row: tuple[Any, ...], suffix: str) -> None:
    function, kind, arguments, taken, refused, told = row
    validation = f'"{function}{suffix}": {arguments}'
    assert [_told(kind, validation, value) for value in taken] == [[]] * len(taken)
    assert [len(_told(kind, validation, value)) for value in refused] == [1] * len(refused)
    assert _told(kind, validation, refused[0]) == [f"'x' {told}"]


def test_every_validation_has_a_row() -> None:
    assert {row[0] for row in ROWS} == set(RULES)


@pytest.mark.parametrize(
    "kind", [*TYPES, "string_fixed_5", "int_array_fixed_5", "double_array_fixed_5", "string_array_fixed_5"]
)
def test_types(kind: str) -> None:
    values: dict[str, ParameterValue] = {
        "bool": True,
        "int": 1,
        "double": 1.5,
        "string": "a",
        "bool_array": (True,),
        "int_array": (1,),
        "double_array": (1.5,),
        "string_array": ("a",),
    }
    plain = kind.removesuffix("_fixed_5")
    for other, value in values.items():
        found = _told(kind, "", value)
        assert (found == []) == (other == plain), (other, found)


def test_a_word_that_yaml_would_read_otherwise_is_suggested_in_quotes() -> None:
    (fault,) = faults("demo: {x: {type: string, validation: {one_of<>: [['off', 'auto']]}}}", x="of")
    assert fault.meant == '"off"'


def test_a_fixed_size_is_the_greatest() -> None:
    assert _told("string_fixed_3", "", "abc") == []
    assert _told("string_fixed_3", "", "abcd") == ["'x' must have at most 3 characters, not 4"]
    assert _told("int_array_fixed_2", "", (1, 2, 3)) == ["'x' must have at most 2 items, not 3"]


def test_functions_of_the_users_own_are_left_to_the_node() -> None:
    assert _told("int", '"my_project::even": null, "my_project::between<>": [1, 2]', 7) == []


@pytest.mark.parametrize(
    ("kind", "value", "meant"),
    [
        ("double", 1, "1.0"),
        ("double", "2.5", "2.5"),
        ("int", 2.0, "2"),
        ("int", 2.5, None),
        ("int", "x", None),
        ("bool", "True", "true"),
        ("bool", 1, "true"),
        ("bool", 2, None),
        ("string", 5, '"5"'),
        ("string_array", "a", '["a"]'),
        ("double_array", (1, 2), "[1.0, 2.0]"),
        ("double_array", 1e-9, "[1.0e-09]"),
    ],
)
def test_how_a_value_should_have_been_written(kind: str, value: ParameterValue, meant: str | None) -> None:
    (fault,) = faults(f"demo: {{x: {{type: {kind}, validation: {{}}}}}}", x=value)
    assert (fault.kind, fault.meant) == ("type", meant)


BROKEN = [
    ("demo: {x: {type: dobule}}", "'dobule' is no type of a parameter", "double"),
    ("demo: {x: {default_value: 3}}", "the parameter 'x' has no `type`", None),
    ("demo: {x: 3}", "'x' is no parameter: that is a mapping with a `type`", None),
    ("demo: {x: {type: int, defualt_value: 3}}", "a parameter has no key 'defualt_value'", "default_value"),
    ("demo: {x: {type: int, validation: {bonds<>: [1, 2]}}}", "there is no validation 'bonds<>'", "bounds<>"),
    ("demo: {x: {type: int, validation: {bounds<>: [1]}}}", "'bounds<>' takes two arguments, not 1", None),
    ("demo: {x: {type: int, validation: {gt<>: [a]}}}", "'gt<>' takes numbers, not 'a'", None),
    ("demo: {x: {type: int, validation: {one_of<>: [1]}}}", "'one_of<>' takes one list of values: [[a, b]]", None),
    ("demo: {x: {type: string, validation: {size_gt<>: [-1]}}}", "'size_gt<>' takes a length, not -1", None),
    ("demo: {x: {type: int, validation: 3}}", "`validation` is a mapping of functions", None),
    ("demo: {x: {type: double, default_value: fast}}", "the default: 'x' is declared as a double; 'fast' is a string, which the node refuses", None),
    ("a: {x: {type: int}}\nb: {}", "a definition of generate_parameter_library has one key, with parameters below it", None),
]  # fmt: skip


@pytest.mark.parametrize(("text", "message", "meant"), BROKEN)
def test_broken_definitions_are_told(tmp_path: Path, text: str, message: str, meant: str | None) -> None:
    path = tmp_path / "d.yaml"
    path.write_text(text, "utf-8")
    problems = Problems()
    read_definition(Document(str(path), text, yaml.safe_load(text)), problems)
    (problem,) = problems
    assert (problem.code, problem.message, problem.suggestion) == (Code.BROKEN_DECLARATION, message, meant)
    assert problem.span is not None

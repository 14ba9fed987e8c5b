"""JSON Schemas: read plainly or by the library, they take what the library takes, and refuse what it refuses."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.declared.documents import Document
from orchestra.declared.json_schema import read_schema
from orchestra.declared.judging import DeclaredParameters
from orchestra.declared.kinds import is_definition, is_schema
from orchestra.declared.plain_schema import read_plain
from orchestra.declared.reading import read_file
from orchestra.errors import Code, Problems

if TYPE_CHECKING:
    from orchestra.declared.model import Fault, ParameterSchema
    from orchestra.values import ParameterValue

_PATIENT = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow])
_names = st.sampled_from(["a", "b", "ab", "limits.max", "limits.min", "c.d.e", "odom0", "odom0_config"])
_numbers = st.integers(-3, 3) | st.sampled_from([-1.5, 0.0, 0.5, 1.0, 2.5])
_words = st.sampled_from(["", "a", "ab", "abc", "fast", "slow"])
_scalars = st.booleans() | _numbers | _words
_values: st.SearchStrategy[Any] = st.one_of(
    _scalars,
    *(
        st.lists(items, min_size=1, max_size=3).map(tuple)
        for items in (st.booleans(), st.integers(-3, 3), _words)
    ),
    st.lists(st.sampled_from([0.5, 1.0]), min_size=1, max_size=3).map(tuple),
)


def _some(**keys: st.SearchStrategy[Any]) -> st.SearchStrategy[dict[str, Any]]:
    return st.fixed_dictionaries({}, optional=keys)


def _both(*parts: st.SearchStrategy[dict[str, Any]]) -> st.SearchStrategy[dict[str, Any]]:
    return st.tuples(*parts).map(lambda found: {key: value for part in found for key, value in part.items()})


_limits = st.one_of(
    _some(minimum=_numbers, maximum=_numbers),
    _some(exclusiveMinimum=_numbers, maximum=_numbers),
    _some(minimum=_numbers, exclusiveMaximum=_numbers),
)
_said = _some(description=_words, default=_scalars, readOnly=st.booleans())
_number = _both(st.fixed_dictionaries({"type": st.sampled_from(["integer", "number"])}), _limits, _said)
_text = _both(
    st.fixed_dictionaries(
        {"type": st.just("string")}, optional={"enum": st.lists(_words, min_size=1, max_size=3)}
    ),
    _some(minLength=st.integers(0, 3), maxLength=st.integers(0, 3)),
)
_choice = st.fixed_dictionaries({"enum": st.lists(_scalars, min_size=1, max_size=3)})
_list = _both(
    st.fixed_dictionaries(
        {
            "type": st.just("array"),
            "items": _number | st.sampled_from([{"type": "boolean"}, {"type": "string"}]),
        }
    ),
    _some(minItems=st.integers(0, 3), maxItems=st.integers(0, 3), uniqueItems=st.booleans()),
)
_property = st.one_of(_number, _text, _choice, _list, st.just({"type": "boolean"}), st.just({}))


@st.composite
def _schemas(draw: Any) -> dict[str, Any]:
    names = draw(st.lists(_names, max_size=4, unique=True))
    flat = draw(st.booleans())
    more = draw(st.sampled_from([{}, {"additionalProperties": True}, {"additionalProperties": False}]))
    schema: dict[str, Any] = {"type": "object", "properties": {}, **more}
    for name in names:
        level = schema
        *groups, last = [name] if flat else name.split(".")
        for group in groups:
            level = level["properties"].setdefault(group, {"type": "object", "properties": {}, **more})
        level["properties"][last] = draw(_property)
    direct = [name for name in names if "." not in name or flat]
    if direct and draw(st.booleans()):
        schema["required"] = draw(st.lists(st.sampled_from(direct), unique=True))
    if draw(st.booleans()):
        schema["patternProperties"] = {"^odom[0-9]": draw(_property)}
    return schema


_given = st.dictionaries(_names, _values, max_size=4)


def _by_library(schema: dict[str, Any]) -> ParameterSchema:
    """Return the schema with a keyword that is not read plainly, and that demands nothing."""
    problems = Problems()
    read = read_schema(Document("s.json", "", {**schema, "minProperties": 0}), problems)
    assert list(problems) == []
    assert read is not None
    assert not isinstance(read, DeclaredParameters)
    return read


def _instance(schema: dict[str, Any], values: dict[str, ParameterValue]) -> dict[str, Any]:
    """Return the values as the schema names them."""
    flat = any("." in name for name in schema["properties"])
    found: dict[str, Any] = {}
    for name, value in values.items():
        *groups, last = [name] if flat else name.split(".")
        level = found
        for group in groups:
            level = level.setdefault(group, {})
        level[last] = list(value) if isinstance(value, tuple) else value
    return found


def _agree(found: list[Fault], *, taken: bool) -> None:
    certain = [fault for fault in found if fault.certain]
    assert (certain == []) if taken else found


@_PATIENT
@given(_schemas(), _given)
def test_the_library_says_the_same_by_way_of_the_tree(schema: dict[str, Any], values: dict[str, Any]) -> None:
    taken = jsonschema.Draft202012Validator(schema).is_valid(_instance(schema, values))
    _agree(list(_by_library(schema).faults(values)), taken=taken)


@_PATIENT
@given(_schemas(), _given)
def test_what_is_read_plainly_means_what_the_library_says(
    schema: dict[str, Any], values: dict[str, Any]
) -> None:
    plain = read_plain(schema)
    if plain is None:
        return
    taken = jsonschema.Draft202012Validator(schema).is_valid(_instance(schema, values))
    _agree(list(DeclaredParameters(plain).faults(values)), taken=taken)


@pytest.mark.parametrize(
    "more",
    [
        {"properties": {"a": {"type": "number", "multipleOf": 2}}},
        {"properties": {"a": {"type": ["integer", "string"]}}},
        {"properties": {"a": {"anyOf": [{"type": "integer"}]}}},
        {"properties": {"a": {"type": "object", "required": ["b"], "properties": {"b": {}}}}},
        {"properties": {"a": {"minimum": 3}}},
        {"properties": {"a": True}},
        {"additionalProperties": {"type": "integer"}},
        {"minProperties": 1},
        {"$ref": "#/$defs/a", "$defs": {"a": {}}},
    ],
)
def test_what_says_more_is_left_to_the_library(more: dict[str, Any]) -> None:
    assert read_plain({"type": "object", **more}) is None


def _faults(schema: dict[str, Any], **values: ParameterValue) -> list[tuple[str, str, str | None, bool]]:
    every = {name.replace("__", "."): value for name, value in values.items()}
    problems = Problems()
    read = read_schema(Document("s.json", json.dumps(schema), schema), problems)
    assert read is not None, list(problems)
    return [(fault.kind, fault.name, fault.meant, fault.certain) for fault in read.faults(every)]


_SPEED = {"type": "object", "properties": {"speed": {"type": "number"}, "count": {"type": "integer"}}}


def test_an_integer_where_a_number_is_declared_is_told_as_uncertain() -> None:
    assert _faults(_SPEED, speed=1) == [("type", "speed", "1.0", False)]
    assert _faults(_SPEED, count=2.0) == [("type", "count", "2", False)]
    assert _faults({**_SPEED, "minProperties": 0}, speed=1) == [("type", "speed", "1.0", False)]


def test_the_type_of_ros_is_exact() -> None:
    exact = {"type": "object", "properties": {"speed": {"type": "number", "x-ros-type": "double"}}}
    assert _faults(exact, speed=1) == [("type", "speed", "1.0", True)]
    assert _faults({**exact, "minProperties": 0}, speed=1) == [("type", "speed", "1.0", True)]
    either = {
        "type": "object",
        "properties": {"speed": {"type": "number", "x-ros-type": ["double", "integer"]}},
    }
    assert _faults(either, speed=1) == []
    assert _faults({**either, "minProperties": 0}, speed=1) == []


def test_a_union_takes_both() -> None:
    assert (
        _faults({"type": "object", "properties": {"speed": {"type": ["integer", "number"]}}}, speed=1) == []
    )


def test_steps_are_counted_from_the_least_value() -> None:
    stepped = {
        "type": "object",
        "properties": {"x": {"type": "integer", "minimum": 1, "maximum": 10, "x-ros-step": 4}},
    }
    assert [value for value in range(12) if not _faults(stepped, x=value)] == [1, 5, 9, 10]


def test_names_that_are_neither_declared_nor_refused() -> None:
    assert _faults(_SPEED, sped=1.0) == [("undeclared", "sped", "speed", False)]
    assert _faults({**_SPEED, "additionalProperties": False}, sped=1.0) == [
        ("undeclared", "sped", "speed", True)
    ]
    assert _faults({**_SPEED, "additionalProperties": True}, sped=1.0) == []


def test_parts_of_a_schema_may_stand_elsewhere_in_it() -> None:
    schema = {
        "type": "object",
        "properties": {"wheels": {"$ref": "#/$defs/wheels"}},
        "allOf": [{"properties": {"mode": {"enum": ["fast", "slow"]}}}],
        "$defs": {"wheels": {"type": "object", "additionalProperties": {"$ref": "#/$defs/wheel"}},
                  "wheel": {"type": "object", "properties": {"radius": {"type": "number", "exclusiveMinimum": 0}}}},
    }  # fmt: skip
    assert _faults(schema, wheels__left__radius=0.1, wheels__right__radius=0.1, mode="fast") == []
    assert _faults(schema, wheels__left__radius=-0.1) == [("value", "wheels.left.radius", None, True)]
    assert _faults(schema, wheels__left__raduis=0.1) == [
        ("undeclared", "wheels.left.raduis", "wheels.left.radius", False)
    ]
    assert _faults(schema, mode="fsat") == [("value", "mode", "fast", True)]


def test_what_a_pattern_says_of_a_group_is_said_of_the_group() -> None:
    """Also where the pattern fits the dotted names of what is in it."""
    gains = {
        "type": "object",
        "properties": {"rate": {"type": "number", "minimum": 0}},
        "additionalProperties": False,
    }
    schema = {
        "type": "object",
        "patternProperties": {"^gain_": gains, "^limits[.]": {"type": "number", "maximum": 1}},
        "additionalProperties": False,
    }
    assert _faults(schema, gain_a__rate=1.0, limits__low=0.5) == []
    assert _faults(schema, gain_a__rate=-1.0) == [("value", "gain_a.rate", None, True)]
    assert _faults(schema, gain_a__raet=1.0) == [("undeclared", "gain_a.raet", "gain_a.rate", True)]
    assert _faults(schema, limits__low=1.5) == [("value", "limits.low", None, True)]


def test_a_slip_in_a_name_by_pattern_is_nearer_than_a_whole_name_that_is_like_it() -> None:
    schema = {
        "type": "object",
        "properties": {"gravitational_acceleration": {"type": "number"}},
        "patternProperties": {"^imu\\d+_remove_gravitational_acceleration$": {"type": "boolean"}},
    }
    assert _faults(schema, imu1_remove_gravitational_accelaration=True) == [
        (
            "undeclared",
            "imu1_remove_gravitational_accelaration",
            "imu1_remove_gravitational_acceleration",
            False,
        )
    ]
    assert _faults(schema, gravitationl_acceleration=9.8) == [
        ("undeclared", "gravitationl_acceleration", "gravitational_acceleration", False)
    ]


def test_what_is_missing_and_what_is_misspelt_is_one_mistake() -> None:
    schema = {**_SPEED, "required": ["speed"], "minProperties": 0}
    assert _faults(schema, sped=1.0) == [("undeclared", "sped", "speed", False)]
    assert _faults(schema) == [("missing", "speed", None, True)]


@pytest.mark.parametrize(
    ("text", "line", "column", "message"),
    [
        (
            '{"type": "object",\n "properties": {"a": {"type": "numbr"}}}',
            2,
            31,
            "no JSON Schema",
        ),
        (
            '{"type": "object",\n "allOf": [{"$ref": "#/$defs/no"}]}',
            2,
            21,
            "the reference '#/$defs/no' leads nowhere",
        ),
        ('{"type": "object",\n "properties": ', 2, 16, "not JSON"),
    ],
)
def test_a_broken_schema_is_told_at_its_place(
    tmp_path: Any, text: str, line: int, column: int, message: str
) -> None:
    path = tmp_path / "s.json"
    path.write_text(text, "utf-8")
    problems = Problems()
    assert read_file(str(path), None, problems) is None
    (problem,) = problems
    assert problem.code == Code.BROKEN_DECLARATION
    assert problem.message.startswith(message)
    assert problem.span is not None
    assert (problem.span.line, problem.span.column) == (line, column)
    assert problem.suggestion == ("number" if "numbr" in text else None)


@pytest.mark.parametrize(
    ("data", "schema", "definition"),
    [
        ({"$schema": "https://json-schema.org/draft/2020-12/schema"}, True, False),
        ({"type": "object"}, True, False),
        ({"properties": {"a": {"type": "number"}}}, True, False),
        ({"properties": {"a": {"type": "double"}}}, False, True),
        ({"driver": {"a": {"type": "double"}}}, False, True),
        ({"driver": {"ros__parameters": {"a": 1}}}, False, False),
        ({"driver": {"ros__parameters": {"a": {"type": "fast"}}}}, False, False),
        ([], False, False),
    ],
)
def test_what_kind_a_file_is_of(data: Any, schema: bool, definition: bool) -> None:
    assert (is_schema(data), is_definition(data)) == (schema, definition)


def test_a_schema_may_refer_to_a_file_beside_it(tmp_path: Any) -> None:
    (tmp_path / "common.json").write_text('{"$defs": {"speed": {"type": "number", "maximum": 2}}}')
    text = '{"$schema": "https://json-schema.org/draft/2020-12/schema", "type": "object", "properties": {"a": {"$ref": "common.json#/$defs/speed"}}}'
    (tmp_path / "s.schema.json").write_text(text)
    problems = Problems()
    read = read_file(str(tmp_path / "s.schema.json"), None, problems)
    assert list(problems) == []
    assert read is not None
    assert [fault.kind for fault in read.faults({"a": 3.0})] == ["value"]
    assert list(read.faults({"a": 1.0})) == []

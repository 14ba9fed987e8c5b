from __future__ import annotations

import math
from typing import TYPE_CHECKING

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from orchestra.resolve.rcl.surprises import of_commas
from orchestra.resolve.scalars import (
    _parsed,
    coerced,
    core_value,
    differs,
    unified,
    upstream_value,
)
from orchestra.resolve.yaml_scalars import by_core, by_pyyaml, value_alike

if TYPE_CHECKING:
    from orchestra.values import ParameterValue


def _same(one: object, other: object) -> bool:
    return repr(one) == repr(other)


@pytest.mark.conforms("2.5 integers", "2.5 floats", "2.5 booleans", "2.6 no type")
@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        ("  5 ", 5),
        ("0x10", 16),
        ("010", 8),
        ("12:30", 750),
        ("1_000", 1000),
        ("0b11", 3),
        ("1.5", 1.5),
        (".5", 0.5),
        ("1.", 1.0),
        (".inf", math.inf),
        ("true", True),
        ("TRUE", True),
        ("off", False),
        ("yes", True),
        ("", ""),
        ("  ", "  "),
        ("abc", "abc"),
        ("a b", "a b"),
        ("0o17", "0o17"),
        ("'5'", "5"),
        ('"true"', "true"),
        ("!!str 5", "5"),
        ("!!int '5'", 5),
        ("|-\n  5", "5"),
        ("[1, 2]", (1, 2)),
        ("- 1", (1,)),
        ("[a, 'b']", ("a", "b")),
        ("[true, no]", (True, False)),
        ("[1.0, .inf]", (1.0, math.inf)),
        ("[&a 1, *a]", (1, 1)),
    ],
)
def test_a_text_is_read_as_pyyaml_reads_it(text: str, value: ParameterValue) -> None:
    assert _same(upstream_value(text), value)


@pytest.mark.conforms("2.5 floats without a point", "2.5 one letter", "D15")
@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1e3", 1000.0),
        ("1e-6", 1e-6),
        ("inf", math.inf),
        ("nan", math.nan),
        ("y", True),
        ("N", False),
        ("0483", 483.0),
        ("'1e3'", "1e3"),
        ("!!str y", "y"),
        ("[1e3, 2.0]", (1000.0, 2.0)),
        ("[y, n]", (True, False)),
        ("[a, y]", ("a", "y")),
        ("['y', 'n']", ("y", "n")),
    ],
)
def test_what_pyyaml_leaves_plain_is_typed_again_by_rcl(text: str, value: ParameterValue) -> None:
    assert _same(upstream_value(text), value)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("null", "null cannot be a parameter"),
        ("~", "null"),
        ("# nothing", "null"),
        ("2024-01-01", "a date"),
        ("2024-13-01", "month"),
        ("!!binary aGk=", "binary data"),
        ("{a: 1}", "a mapping"),
        ("a: b", "a mapping"),
        ("[]", "an empty list has no type"),
        ("[[1]]", "a list of lists"),
        ("[{a: 1}]", "a list of lists or mappings"),
        ("[1, a]", "one type, not 1 and 'a'"),
        ("[1, 2.5]", "one type, not 1 and 2.5"),
        ("[true, 1]", "one type, not true and 1"),
        ("[1, ~]", "null"),
        ("9223372036854775808", "64 bits"),
        ("@x", "is not YAML"),
        ("[1", "is not YAML"),
        ("1\n---\n2", "more than one YAML document"),
        ("=", "means nothing"),
        ("!!foo 1", "means nothing"),
        ("!!int abc", "invalid literal"),
        ('"\\0"', "NUL"),
        ("*a", "an alias without an anchor"),
        ("[*a]", "has no anchor"),
    ],
)
def test_what_cannot_be_a_parameter_is_told(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        upstream_value(text)


@pytest.mark.conforms("D14")
@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("010", 10),
        ("0o17", 15),
        ("0x1F", 31),
        ("12:30", "12:30"),
        ("1_000", "1_000"),
        ("yes", "yes"),
        ("y", "y"),
        ("True", True),
        ("1e3", 1000.0),
        ("-.INF", -math.inf),
        (".nan", math.nan),
        ("inf", "inf"),
        ("2024-01-01", "2024-01-01"),
        ("'5'", "5"),
        ("[on, off]", ("on", "off")),
    ],
)
def test_the_core_schema_reads_less_into_a_text(text: str, value: ParameterValue) -> None:
    assert _same(core_value(text), value)


@pytest.mark.conforms("D14")
@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("010", "'010' is read as the integer 8, as ROS 2 does; YAML 1.2 reads the integer 10"),
        ("12:30", "'12:30' is read as the integer 750, as ROS 2 does; YAML 1.2 reads the text '12:30'"),
        ("yes", "'yes' is read as the boolean true, as ROS 2 does; YAML 1.2 reads the text 'yes'"),
        (
            "[on, off]",
            "'[on, off]' is read as the list [true, false], as ROS 2 does; YAML 1.2 reads the list ['on', 'off']",
        ),
        ("0o17", "'0o17' is read as the text '0o17', as ROS 2 does; YAML 1.2 reads the integer 15"),
        ("1_000", "'1_000' is read as the integer 1000, as ROS 2 does; YAML 1.2 reads the text '1_000'"),
    ],
)
def test_a_surprise_is_told(text: str, sentence: str) -> None:
    assert differs(text) == sentence


@pytest.mark.parametrize(
    "text", ["1", "1.5", "1e3", "true", "abc", "", "'010'", "[1, 2]", ".nan", "null", "[]"]
)
def test_the_unsurprising_is_not_told(text: str) -> None:
    assert differs(text) is None


@pytest.mark.parametrize(
    ("text", "word", "value"),
    [
        ("1", "str", "1"),
        (" 5 ", "int", 5),
        ("1e3", "float", 1000.0),
        ("5", "float", 5.0),
        ("nan", "float", math.nan),
        ("1", "bool", True),
        ("0", "bool", False),
        (" yes", "bool", True),
        ("OFF", "bool", False),
        ("[1, 2]", "list_of_int", (1, 2)),
        ("[1, 2.5, 1e3]", "list_of_float", (1.0, 2.5, 1000.0)),
        ("[a, '1', y]", "list_of_str", ("a", "1", "y")),
        ("[true, no]", "list_of_bool", (True, False)),
        ("010", "yaml", 8),
    ],
)
def test_a_type_word_decides(text: str, word: str, value: ParameterValue) -> None:
    assert _same(coerced(text, word), value)


@pytest.mark.parametrize(
    ("text", "word", "reason"),
    [
        ("0x10", "int", "'0x10' is no integer"),
        ("1.5", "int", "no integer"),
        ("abc", "float", "no float"),
        ("y", "bool", "no boolean"),
        ("2", "bool", "no boolean"),
        ("", "bool", "no boolean"),
        ("1", "list_of_int", "no list"),
        ("[1, true]", "list_of_int", "the boolean true does not fit"),
        ("[1, 2]", "list_of_str", "the integer 1 does not fit into a list_of_str"),
        ("[]", "list_of_str", "empty"),
        ("1", "integer", "'integer' is no type"),
        ("1", "list_of_ints", "did you mean 'list_of_int'"),
        (str(2**63), "int", "64 bits"),
        ("\0", "str", "NUL"),
    ],
)
def test_what_does_not_fit_the_type_word_is_told(text: str, word: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        coerced(text, word)


def test_lists_become_of_one_type() -> None:
    assert _same(unified([1, 2.5]), (1.0, 2.5))
    assert _same(unified([True, False]), (True, False))
    assert _same(unified(["a"]), ("a",))


@pytest.mark.parametrize("values", [[], [1, True], [1, "a"], [(1,), (2,)], [1, 2.0, True]])
def test_lists_that_cannot_be_of_one_type_are_refused(values: list[ParameterValue]) -> None:
    with pytest.raises(ValueError, match="list"):
        unified(values)


@given(st.text(alphabet="0123456789.:_-+eExoabyn~[],' ", max_size=8))
def test_numbers_are_those_of_pyyaml(text: str) -> None:
    try:
        value = upstream_value(text)
    except ValueError:
        return
    if not text.strip():
        return
    loaded = yaml.safe_load(text)
    if isinstance(loaded, bool | int | float):
        assert _same(value, loaded)
    elif isinstance(loaded, list):
        assert isinstance(value, tuple)
        assert len(value) == len(loaded)
    else:
        assert isinstance(loaded, str)


@given(st.text("aeflnorstuyNOTFY_/.-0123456789", max_size=6) | st.floats().map(str) | st.integers().map(str))
def test_what_needs_no_parser_is_what_the_parsers_say(text: str) -> None:
    alike = value_alike(text)
    if alike is not None:
        assert _same(_parsed(text, by_pyyaml), alike)
        assert _same(_parsed(text, by_core), alike)


_SIGNS = st.text("at:# ,.'\"\\\\[]{}()&*!%@|>?=~-+;$/_0", max_size=8)


@given(
    st.sampled_from(("", "a", "true", "Nan", "/", "'", '"', "1", "_ ")),
    _SIGNS,
    st.sampled_from(("", "'", '"')),
)
def test_texts_of_any_signs_that_need_no_parser_are_what_the_parsers_say(
    begun: str, signs: str, ended: str
) -> None:
    text = f"{begun}{signs}{ended}"
    alike = value_alike(text)
    if alike is not None:
        assert _same(_parsed(text, by_pyyaml), alike)
        assert _same(_parsed(text, by_core), alike)
        assert not isinstance(alike, str) or of_commas(text) is None


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("robot 864", "robot 864"),
        ("package://robot/meshes/a b.stl", "package://robot/meshes/a b.stl"),
        ("map -> odom, base", "map -> odom, base"),
        ("192.168.1.201", "192.168.1.201"),
        ("'0.5'", "0.5"),
        ('"true"', "true"),
        ("''", ""),
    ],
)
def test_words_and_quotes_need_no_parser(text: str, value: str) -> None:
    assert value_alike(text) == value


@pytest.mark.parametrize(
    "text", ["true, or false", "nan(1)", "a: b", "a #b", "a ", "a:", "'a'b", "1.000.000.000", "2 m", "a\tb"]
)
def test_texts_that_are_not_plain_are_left_to_the_parsers(text: str) -> None:
    assert value_alike(text) is None


_ITEMS = st.text("aeflnorstuyNO_/.-0123456789'\"", max_size=5) | st.floats().map(str) | st.integers().map(str)


@pytest.mark.parametrize("text", ["true", "false"])
def test_true_and_false_need_no_parser(text: str) -> None:
    assert value_alike(text) is (text == "true")
    assert _same(_parsed(text, by_pyyaml), value_alike(text))
    assert _same(_parsed(text, by_core), value_alike(text))


@given(st.lists(_ITEMS, max_size=4), st.sampled_from((",", ", ", ",  ", " ,")), st.sampled_from(("", " ")))
def test_lists_that_need_no_parser_are_what_the_parsers_say(
    items: list[str], between: str, around: str
) -> None:
    text = f"[{around}{between.join(items)}{around}]"
    alike = value_alike(text)
    if alike is not None:
        assert _same(_parsed(text, by_pyyaml), alike)
        assert _same(_parsed(text, by_core), alike)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("[true,false]", (True, False)),
        ("[1.0, 2.0]", (1.0, 2.0)),
        ("[a,b]", ("a", "b")),
        ("[ 1 ]", (1,)),
        ("[/a/b, c.d]", ("/a/b", "c.d")),
        ("['a, b', c, \"[d]\"]", ("a, b", "c", "[d]")),
        ("[-1, 0,  12]", (-1, 0, 12)),
    ],
)
def test_plain_lists_need_no_parser(text: str, value: tuple[object, ...]) -> None:
    assert value_alike(text) == value


@pytest.mark.parametrize(
    "text",
    ["[]", "[1, 2.0]", "[a, y]", "[1, a]", "[1", "[a: b]", "[- a]", "['a'b]", "['1', 1]", "[a,,b]", "[1,]"],
)
def test_lists_that_are_not_plain_are_left_to_the_parsers(text: str) -> None:
    assert value_alike(text) is None

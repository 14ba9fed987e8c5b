from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.errors import Code, Problems, Severity
from orchestra.location import Span
from orchestra.resolve.rcl.files import read_parameter_file
from orchestra.resolve.rcl.table import Table, tabulated

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.resolve.rcl.sections import Section


def _read(text: str) -> tuple[tuple[Section, ...], Problems]:
    problems = Problems()
    return read_parameter_file(text, "f.yaml", problems), problems


def _warnings(problems: Problems) -> list[tuple[str, str]]:
    return [
        (str(problem.span), problem.message) for problem in problems if problem.severity is Severity.WARNING
    ]


def _flat(section: Section) -> dict[str, Any]:
    return {entry.name: entry.value for entry in section.entries if entry.value is not None}


@pytest.mark.conforms("4.6.4 shape", "4.6.4 node keys")
def test_sections_and_entries_come_in_order_with_their_places() -> None:
    sections, problems = _read(
        "/robot1/ekf:\n"
        "  ros__parameters:\n"
        "    rate: 30.0\n"
        "    frames: {odom: grüß, base: [a,\n"
        "      b]}\n"
        "ns:\n"
        "  n:\n"
        "    ros__parameters: {x: 1}\n"
    )
    assert not len(problems)
    assert [section.pattern for section in sections] == ["/robot1/ekf", "ns/n"]
    assert _flat(sections[0]) == {"rate": 30.0, "frames.odom": "grüß", "frames.base": ("a", "b")}
    places = {entry.name: (entry.key.span, entry.location.span) for entry in sections[0].entries}
    assert places["rate"] == (Span("f.yaml", 3, 5, 3, 9), Span("f.yaml", 3, 11, 3, 15))
    assert places["frames.odom"][1] == Span("f.yaml", 4, 20, 4, 24)
    assert places["frames.base"] == (Span("f.yaml", 4, 26, 4, 30), Span("f.yaml", 4, 32, 5, 9))
    assert sections[1].location.span == Span("f.yaml", 7, 3, 7, 4)


def test_what_is_wrong_above_a_fault_of_the_text_is_told_with_it() -> None:
    """What is told of the keys around the fault may follow from it, but for what was wrong before."""
    _, problems = _read("/n*m:\n  ros__parameters:\n    a: b   c: d\n")
    spans = sorted(problem.span for problem in problems if problem.span is not None)
    assert spans == [Span("f.yaml", 1, 1, 1, 5), Span("f.yaml", 3, 8, 3, 16)]


@pytest.mark.parametrize(
    "text", ["\ufeff/n:\n  ros__parameters: {x: 1}\n", "/n:\r\n  ros__parameters: {x: 1}\r\n"]
)
def test_marks_and_line_ends_of_other_systems_do_not_matter(text: str) -> None:
    (section,), problems = _read(text)
    assert not len(problems)
    assert section.pattern == "/n"
    assert section.entries[0].location.span == Span("f.yaml", 2, 24, 2, 25)


def test_the_chain_of_includes_goes_with_every_place() -> None:
    chain = (Span("launch.yaml", 1, 2, 3, 4),)
    problems = Problems()
    (section,) = read_parameter_file("/n:\n  ros__parameters: {x: 1, y: }\n", "f.yaml", problems, chain)
    assert section.entries[0].location.included_from == chain
    assert problems.errors[0].included_from == chain


@pytest.mark.parametrize("text", ["", "# nothing\n", "/n:\n  ros__parameters: {}\n", "abc\n"])
def test_files_that_set_nothing_are_accepted(text: str) -> None:
    sections, problems = _read(text)
    assert not len(problems)
    assert not [entry for section in sections for entry in section.entries]


def test_a_file_may_hold_several_documents() -> None:
    sections, problems = _read("/n:\n  ros__parameters: {x: 1}\n---\n/m:\n  ros__parameters: {x: 2}\n")
    assert not len(problems)
    assert [(section.pattern, _flat(section)) for section in sections] == [("/n", {"x": 1}), ("/m", {"x": 2})]


@pytest.mark.conforms("4.6.4 aliases", "4.6.4 shape")
@pytest.mark.parametrize(
    ("text", "place", "part"),
    [
        ("/n:\n", "1:1", "'/n' is empty: parameters belong below 'ros__parameters'"),
        ("/n:\n  x: 1\n", "1:1", "'ros__parameters' is missing below '/n'"),
        ("/n:\n  ros__parameters:\n", "2:3", "must hold a mapping"),
        ("/n:\n  ros__parameters: [1]\n", "2:20", "a list cannot stand above"),
        ("ros__parameters:\n  x: 1\n", "1:1", "below the name of a node"),
        ("- a\n", "1:1", "must be a mapping"),
        ("---\n", "2:1", "an empty document"),
        ("/n:\n  ros__parameters:\n    x:\n    y: 1\n", "3:5", "'x' has no value"),
        ("/n:\n  ros__parameters: {'': 1}\n", "2:21", "a key must not be empty"),
        ("/n:\n  ros__parameters: {x: &a 1, y: *a}\n", "2:33", "aliases ('*a')"),
        ("/n: &a\n  ros__parameters: {}\n/m:\n  <<: *a\n", "4:7", "aliases"),
        ("/n:\n  ros__parameters: {x: [[1], [2]]}\n", "2:24", "a list of lists"),
        ("/n:\n  ros__parameters: {[1]: 2}\n", "2:21", "a list cannot be a key"),
        ("/n:\n  ros__parameters: {? {a: 1} : 2}\n", "2:23", "a mapping cannot be a key"),
        ("/ns:\n  /n:\n    ros__parameters: {}\n", "2:3", "'/ns//n' cannot be the name of a node"),
        ("/n*:\n  ros__parameters: {}\n", "1:1", "'*'"),
        ("/n:\n\tros__parameters: {}\n", "2:1", "a tab cannot indent"),
        ("/n:\n  ros__parameters:\n    x: @y\n", "3:8", "cannot begin with @"),
        ("/n:\n  ros__parameters:\n    x: 'y\n", "3:8", "' is not closed"),
        (
            "/n:\n  ros__parameters: {x: 1}\n  m:\n    ros__parameters: {y: 1}\n",
            "3:3",
            "write its full name apart",
        ),
        ("/n: \x01\n", "1:5", "U+0001"),
        ("/n: \ud800\n", "1:1", "surrogate"),
    ],
)
def test_what_rcl_refuses_is_told_with_its_place(text: str, place: str, part: str) -> None:
    _, problems = _read(text)
    assert [problem.code for problem in problems.errors] == [Code.PARAMETER_SYNTAX]
    assert part in problems.errors[0].message
    assert str(problems.errors[0].span) == f"f.yaml:{place}"


@pytest.mark.conforms("4.6.4 arrays")
def test_a_list_of_several_types_is_told_at_the_item_that_does_not_fit() -> None:
    _, problems = _read("/n:\n  ros__parameters:\n    x: [1, 2, 3.0, a]\n")
    (problem,) = problems.errors
    assert (problem.code, str(problem.span)) == (Code.PARAMETER_TYPE, "f.yaml:3:15")
    assert problem.message == "a list must hold values of one type, not integer and float"


def test_whole_numbers_after_a_first_float_are_to_get_a_point() -> None:
    """A covariance as ROS 1 took it; however many whole numbers there are, the float is not the odd one."""
    _, problems = _read("/n:\n  ros__parameters:\n    x: [1e-9, 0, 0, 0]\n")
    (problem,) = problems.errors
    assert str(problem.span) == "f.yaml:3:15"
    assert problem.message == "a list must hold values of one type, not float and integer"
    assert problem.suggestion == "0.0"


def test_a_word_in_a_list_that_is_a_boolean_is_pointed_out() -> None:
    """The `y` of YAML 1.1."""
    _, problems = _read("/n: {ros__parameters: {axes: [x, y]}}")
    assert [problem.notes for problem in problems.errors] == [
        ("'y' is read as true where it is not in quotes",)
    ]


def test_one_reading_tells_of_several_errors() -> None:
    sections, problems = _read(
        "/a:\n"
        "/b:\n"
        "  x: 1\n"
        "  ros__parameters:\n"
        "    v:\n"
        "    w: [1, a]\n"
        "    x: *y\n"
        "    z: 1\n"
        "/c*:\n"
        "  ros__parameters: {q: 1}\n"
        "/d:\n"
        "  ros__parameters:\n"
        "/e:\n"
        "  ros__parameters: {z: 2}\n"
    )
    assert [problem.span.line for problem in problems.ordered if problem.span] == [1, 3, 5, 6, 7, 9, 12]
    assert [(section.pattern, _flat(section)) for section in sections if section.entries] == [
        ("/b", {"z": 1}),
        ("/e", {"z": 2}),
    ]


@pytest.mark.conforms("4.6.4 duplicate keys", "D67")
@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ("a: 1\n    a: 2", "4:5", "'a' is set twice for '/n'; this value counts"),
        ("a.b: 1\n    a: {b: 2}", "4:9", "'a.b' is set twice for '/n'; this value counts"),
        ("a: 1\n    a: text", "4:5", "'a' is set twice for '/n'; rcl keeps the one at f.yaml:3:8"),
        ("a: 1\n    a: {b: 2}", "4:9", "rcl drops the value of 'a' at f.yaml:3:8 for the sake of 'a.b'"),
        ("a: 1\n    a: {b: text}", "4:9", "rcl gives 'a.b' the value of 'a' at f.yaml:3:8"),
    ],
)
def test_what_is_set_twice_is_told(text: str, place: str, message: str) -> None:
    _, problems = _read(f"/n:\n  ros__parameters:\n    {text}\n")
    assert _warnings(problems) == [(f"f.yaml:{place}", message)]
    assert {problem.code for problem in problems} == {Code.DUPLICATE_PARAMETER}


@pytest.mark.conforms("4.6.4 duplicate keys")
def test_sections_of_one_pattern_count_together() -> None:
    _, problems = _read("/n:\n  ros__parameters: {a: 1}\n/n:\n  ros__parameters: {a: 2, b: 3}\n")
    assert [place for place, _ in _warnings(problems)] == ["f.yaml:4:21"]


@pytest.mark.parametrize(
    ("text", "place", "part"),
    [
        ("x: {a.b: {c: 1}, d: 2}", "3:22", "reads this as the parameter 'x.a.d', not 'x.d'"),
        ("x: {a: {}, b: 1}", "3:16", "reads this as the parameter 'x.a.b', not 'x.b'"),
        ("x: [{a: 1}]", "3:9", "a list of mappings is no parameter"),
        ("x: [[1]]", "3:9", "cannot be a list of lists"),
    ],
)
def test_what_rcl_reads_in_another_way_is_told(text: str, place: str, part: str) -> None:
    _, problems = _read(f"/n:\n  ros__parameters:\n    {text}\n")
    ((where, message),) = _warnings(problems)
    assert part in message
    assert where == f"f.yaml:{place}"


def test_a_node_that_rcl_calls_otherwise_is_told() -> None:
    sections, problems = _read(
        "ns:\n  sub/m:\n    ros__parameters: {}\n  n:\n    ros__parameters: {}\nx:\n  ros__parameters_: {}\n"
    )
    assert [section.pattern for section in sections] == ["ns/sub/m", "ns/sub/n", "x"]
    assert [message for _, message in _warnings(problems)] == [
        "rcl reads this as the section of 'ns/sub/n', not of 'ns/n'",
        "rcl reads 'ros__parameters_' as 'ros__parameters'",
    ]


def test_an_empty_mapping_ends_the_section() -> None:
    _, problems = _read("/n:\n  ros__parameters:\n    a: {}\n    b: 1\n")
    (problem,) = problems.errors
    assert str(problem.span) == "f.yaml:4:5"
    assert problem.notes == ("the empty mapping at f.yaml:3:9 ends the section for rcl",)


_SCALARS = st.sampled_from(
    ["1", "-1", "1.5", "true", "y", "abc", '"q"', "0452", "1e3", "~", ".inf", "&a 1", "!!str 1", "'1'"]
)
_KEYS = st.sampled_from(["a", "b", "c", "a.b", "a.b.c", "1", '"x y"', "ros__parameters", "yes"])
_LISTS = st.builds(
    lambda item, size: [item] * size, st.sampled_from(["1", "a", "1.5", "no"]), st.integers(0, 3)
).map(lambda items: f"[{', '.join(items)}]")
_RARE = st.sampled_from(
    ["[1, a]", "[[1]]", "[{a: 1}]", "[[1], [2]]", "*a", "", "{}", "@x", "|-\n          5"]
)
_PATTERNS = st.sampled_from(["/**", "/ns/n", "ns/n", "n", "/*", "/**/n", "ns", "/", "sub/n", "1n", '"*"'])


def _mapping(pairs: list[tuple[str, str]]) -> str:
    return "{" + ", ".join(f"{key}: {value}" for key, value in pairs) + "}"


def _section(indent: str, pairs: list[tuple[str, str]]) -> str:
    lines = "".join(f"{indent}  {key}: {value}\n" for key, value in pairs)
    return f"\n{indent}ros__parameters:\n{lines}"


_VALUES = st.recursive(
    st.one_of(_SCALARS, _SCALARS, _LISTS),
    lambda inner: st.lists(st.tuples(_KEYS, inner), min_size=1, max_size=3).map(_mapping),
    max_leaves=4,
)
_PAIRS = st.lists(st.tuples(_KEYS, st.one_of(*([_VALUES] * 12), _RARE)), min_size=1, max_size=4)
_NODES = st.one_of(
    *([_PAIRS.map(lambda pairs: _section("  ", pairs))] * 5),
    st.lists(st.tuples(_PATTERNS, _PAIRS), min_size=1, max_size=2).map(
        lambda nodes: "\n" + "".join(f"  {name}:{_section('    ', pairs)}" for name, pairs in nodes)
    ),
)
_FILES = st.lists(st.tuples(_PATTERNS, _NODES), min_size=1, max_size=3).map(
    lambda nodes: "".join(f"{name}:{node}" for name, node in nodes)
)


def _plain(table: Table) -> list[list[object]]:
    def value(found: Any) -> Any:
        return list(found) if isinstance(found, tuple) else found

    return [
        [pattern, [[slot.name, value(slot.entry.value) if slot.entry else None] for slot in slots]]
        for pattern, slots in table.items()
    ]


def _agree(ask_rcl: Callable[..., Any], texts: list[str]) -> None:
    """What is read without an error is what rcl has; what rcl refuses has an error."""
    real = ask_rcl("parse", texts=texts)
    problems = Problems()
    sections = [section for text in texts for section in read_parameter_file(text, "f.yaml", problems)]
    if isinstance(real, dict):
        assert problems.errors, real["error"]
    elif not problems.errors:
        assert repr(_plain(tabulated(sections))) == repr(real)


_TWICE = """\
/**:
  ros__parameters: {a: 1}
/**:
  n:
    ros__parameters: {b: 2}
ns:
  n:
    ros__parameters: {c: 3}
ns:
  m:
    ros__parameters: {d: 4}
  n:
    ros__parameters: {e: 5}
"""


def test_a_node_may_stand_below_a_name_that_had_parameters_in_a_mapping_before(
    ask_rcl: Callable[..., Any],
) -> None:
    """As in the files that rclcpp is tested with."""
    sections, problems = _read(_TWICE)
    assert not list(problems)
    assert [section.pattern for section in sections] == ["/**", "/**/n", "ns/n", "ns/m", "ns/n"]
    _agree(ask_rcl, [_TWICE])


@pytest.mark.conforms("4.6.4 shape", "4.6.4 node keys", "4.6.4 string")
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=300,
)
@given(texts=st.lists(_FILES, min_size=1, max_size=2))
def test_files_are_read_as_by_the_real_parser(ask_rcl: Callable[..., Any], texts: list[str]) -> None:
    _agree(ask_rcl, texts)


@pytest.mark.long
@settings(suppress_health_check=list(HealthCheck), deadline=None, max_examples=5_000)
@given(texts=st.lists(_FILES, min_size=1, max_size=2))
def test_many_files_are_read_as_by_the_real_parser(ask_rcl: Callable[..., Any], texts: list[str]) -> None:
    _agree(ask_rcl, texts)


def test_a_node_whose_name_is_somewhat_like_the_key_of_sections_is_a_node() -> None:
    sections, problems = _read("/ns:\n  ros_pwm:\n    ros__parameters: {a: 1}\n")
    assert [section.pattern for section in sections] == ["/ns/ros_pwm"]
    assert not list(problems)

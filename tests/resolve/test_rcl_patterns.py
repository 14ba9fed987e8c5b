from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.resolve.names import full_name
from orchestra.resolve.rcl.patterns import matches, pattern_fault

if TYPE_CHECKING:
    from collections.abc import Callable


@pytest.mark.conforms("4.6.4 wildcards")
@pytest.mark.parametrize(
    "pattern",
    ["/ns/n", "ns/n", "/**", "**", "/**/n", "/*/n", "/ns/*", "/ns/**", "/*/*", "/**/ns/n", "/ns/n/**"],
)
def test_what_matches_a_node_in_a_namespace(pattern: str) -> None:
    assert matches(pattern, "/ns/n")


@pytest.mark.conforms("4.6.4 wildcards")
@pytest.mark.parametrize(
    "pattern", ["n", "/n", "/*", "*", "/ns", "/*/*/*", "/ns/m", "/nsx/n", "/*/ns/n", "/n/ns"]
)
def test_what_does_not_match_it(pattern: str) -> None:
    assert not matches(pattern, "/ns/n")


@pytest.mark.conforms("4.6.4 relative key")
def test_a_pattern_without_slash_means_the_root() -> None:
    assert matches("n", "/n")
    assert matches("*", "/n")
    assert not matches("n", "/ns/n")


@pytest.mark.parametrize(
    ("pattern", "offset", "part"),
    [
        ("/n*", 2, "not '*'"),
        ("/ns//n", 4, "'//'"),
        ("//n", 1, "'//'"),
        ("/ns/", 4, "empty"),
        ("/a b/n", 2, "not ' '"),
        ("a b/n", 1, "not ' '"),
        ("/ns/1n", 4, "digit"),
        ("/***/n", 1, "not '*'"),
        ("", 0, "empty"),
    ],
)
def test_a_pattern_that_rcl_refuses_is_told_with_its_place(pattern: str, offset: int, part: str) -> None:
    fault = pattern_fault(pattern)
    assert fault is not None
    assert part in fault.reason
    assert fault.offset == offset


@pytest.mark.parametrize(
    "name", ["$(var ns)/n", "<robot_namespace>/n", "n<suffix>", "{{ robot }}", "${NS}/n"]
)
def test_what_is_replaced_before_rcl_reads_a_file_is_not_judged(name: str) -> None:
    assert pattern_fault(name) is not None
    assert pattern_fault(name, template=True) is None


@pytest.mark.parametrize("name", ["<n", "n>", "a < b", "a/<b/c>", "{n}", "$n", "<>"])
def test_what_nothing_replaces_is_judged_in_a_template_too(name: str) -> None:
    assert pattern_fault(name, template=True) is not None


_PARTS = st.sampled_from(["n", "ns", "*", "**", "a__b", "", "n*", "1n", "a b", "x"])
_PATTERNS = st.builds(
    str.__add__, st.sampled_from(["", "/"]), st.lists(_PARTS, min_size=1, max_size=4).map("/".join)
)


@pytest.mark.conforms("4.6.4 wildcards")
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=150,
)
@given(pattern=_PATTERNS, namespace=st.sampled_from(["/", "/ns", "/ns/x", "/x/ns", "/ns/ns/ns"]))
def test_patterns_match_as_in_the_real_node(
    ask_rcl: Callable[..., Any], pattern: str, namespace: str
) -> None:
    text = f'"{pattern}":\n  ros__parameters: {{a: 1}}\n'
    answer = ask_rcl("node", arguments=["--ros-args", "--params-file", [text]], namespace=namespace)
    if not pattern:
        assert "error" in answer
    elif "error" in answer:
        assert pattern_fault(pattern) is not None
    else:
        assert pattern_fault(pattern) is None
        assert bool(answer["parameters"]) == matches(pattern, full_name(namespace, "n"))

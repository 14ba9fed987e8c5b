from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from orchestra.resolve.rcl.overrides import Override, override_value, read_override
from orchestra.resolve.rcl.patterns import matches

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.values import ParameterValue


@pytest.mark.parametrize(
    ("text", "override"),
    [
        ("x:=1", Override("/**", "x", 1)),
        ("x:=a:=b", Override("/**", "x", "a:=b")),
        ("n:x:=yes", Override("n", "x", True)),
        ("a.b.c:=[1, 2]", Override("/**", "a.b.c", (1, 2))),
        ("qos_overrides./t.publisher.depth:=5", Override("/**", "qos_overrides./t.publisher.depth", 5)),
        ("x:=[]", Override("/**", "x", None)),
        ("x:=# nothing", Override("/**", "x", None)),
    ],
)
def test_an_override_is_read(text: str, override: Override) -> None:
    assert read_override(text) == override


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1", 1),
        (" 1", 1),
        ("1e3", 1000.0),
        (".inf", math.inf),
        ("'1'", "1"),
        ("!!str 1", "1"),
        ("a b", "a b"),
        ("~", "~"),
        ("- 1", (1,)),
        ("[a, b]", ("a", "b")),
        ("[[1]]", (1,)),
        ("[1, [2, 3]]", (2, 3)),
        ("[a, [1]]", (1,)),
        ("1\n---\n2", 2),
        ("a\n---\n2\n---\nb", 2),
    ],
)
def test_values_are_those_of_the_command_line(text: str, value: ParameterValue) -> None:
    assert repr(override_value(text)) == repr(value)


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("x", "no ':='"),
        ("x:=", "a value is missing"),
        ("x:=---", "a value is missing"),
        ("x:={b: 1}", "is a mapping"),
        ("x:=*a", "is an alias"),
        ("x:=[1, 2.0]", "one type, not 1 and 2.0"),
        ('x:="a', "is not YAML"),
        ("1x:=1", "does not take '1x'"),
        ("a..b:=1", "does not take 'a..b'"),
        ("__a:=1", "does not take '__a'"),
        ("/ns/n:x:=1", "no namespace here"),
        (":x:=1", "is no name of a node"),
    ],
)
def test_what_rcl_refuses_is_told(text: str, reason: str) -> None:
    with pytest.raises(ValueError, match=reason):
        read_override(text)


_NAMES = st.text(alphabet="ab1_./:", min_size=1, max_size=7)
_VALUES = st.sampled_from(
    ["1", "a", "yes", "[1, 2]", "[1, a]", "[[1], 2]", "[1, [a]]", "{}", "&a 1", "|", "[a, [1], y]", "", "1 2"]
)


@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=200,
)
@given(name=_NAMES, value=_VALUES)
def test_overrides_are_read_as_by_the_real_node(ask_rcl: Callable[..., Any], name: str, value: str) -> None:
    assume("//" not in name)  # `a://b` begins with what rcl reads as the scheme of a URL
    answer = ask_rcl("node", arguments=["--ros-args", "-p", f"{name}:={value}"], namespace="/", name="a")
    try:
        override = read_override(f"{name}:={value}")
    except ValueError:
        assert "error" in answer
        return
    expected = list(override.value) if isinstance(override.value, tuple) else override.value
    assert "error" not in answer
    assert answer["parameters"] == ({override.name: expected} if matches(override.pattern, "/a") else {})

"""What the plan writes for a node is what rcl reads: by our reader, by the real parser, by a real node."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.errors import Problems
from orchestra.plan.parameter_file import rendered
from orchestra.resolve.rcl.effective import effective
from orchestra.resolve.rcl.files import read_parameter_file

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.values import ParameterValue

_TEXTS = st.text(st.characters(exclude_categories=["Cs"], exclude_characters="\0")) | st.sampled_from(
    [
        "1",
        "true",
        "y",
        ".inf",
        "~",
        "a\nb",
        " a ",
        "#",
        "'",
        '"',
        "\\",
        "\x85",
        "\u2028",
        "\ufeff",
        "\uffff",
        "😀",
        "ros__parameters",
    ]
)
_INTEGERS = st.integers(-(2**63), 2**63 - 1)
_SCALARS = st.one_of(st.booleans(), _INTEGERS, st.floats(), _TEXTS)
_VALUES = st.one_of(
    _SCALARS,
    *(
        st.lists(items, min_size=1, max_size=4).map(tuple)
        for items in (st.booleans(), _INTEGERS, st.floats(), _TEXTS)
    ),
)
_PARAMETERS = st.dictionaries(_TEXTS.filter(bool), _VALUES, max_size=5)


def _same(read: object, value: object) -> bool:
    """Compare with types and the sign of zero; every NaN is NaN."""
    if isinstance(value, tuple):
        return isinstance(read, list | tuple) and all(map(_same, read, value)) and len(read) == len(value)
    if isinstance(value, float) and math.isnan(value):
        return isinstance(read, float) and math.isnan(read)
    return type(read) is type(value) and repr(read) == repr(value)


def _check(ask_rcl: Callable[..., Any], parameters: dict[str, ParameterValue]) -> None:
    text = rendered("/ns/n", parameters)
    problems = Problems()
    ours = effective(read_parameter_file(text, "n.yaml", problems), "/ns/n")
    # Names as `/a` and `a b`, and `ros__parameters`.
    assert all(re.search("^no node declares|stands inside itself", found.message) for found in problems)
    assert list(ours) == list(parameters)
    assert all(_same(ours[name].value, value) for name, value in parameters.items())
    ((pattern, read),) = ask_rcl("parse", texts=[text])
    assert pattern == "/ns/n"
    assert [name for name, _ in read] == list(parameters)
    assert all(_same(found, parameters[name]) for name, found in read)


@pytest.mark.conforms("D15", "D22")
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=300,
)
@given(parameters=_PARAMETERS)
def test_every_value_comes_back(ask_rcl: Callable[..., Any], parameters: dict[str, ParameterValue]) -> None:
    _check(ask_rcl, parameters)


@pytest.mark.long
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=5_000,
)
@given(parameters=_PARAMETERS)
def test_every_one_of_many_values_comes_back(
    ask_rcl: Callable[..., Any], parameters: dict[str, ParameterValue]
) -> None:
    _check(ask_rcl, parameters)


@pytest.mark.conforms("D15", "D22", "4.6.3 lists")
def test_a_real_node_has_the_parameters(ask_rcl: Callable[..., Any]) -> None:
    parameters: dict[str, ParameterValue] = {
        "x": 1,
        "x.y": 1.0,
        "switch": "on",
        "gains": (1.0, 1e300, -0.0),
        "labels": ("1", "a"),
        "a name: with #": True,
        "n" * 2000: 1,
    }
    arguments = ["--ros-args", "--params-file", [rendered("/ns/n", parameters)]]
    answer = ask_rcl("node", arguments=arguments)["parameters"]
    assert list(answer) == list(parameters)
    assert all(_same(answer[name], value) for name, value in parameters.items())

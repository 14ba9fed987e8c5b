"""What is written for a parameter is what a running node has: type and value, from every form it can be written in."""

from __future__ import annotations

import math
import os
import re
from contextlib import chdir
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.parameter_file import contents
from tests.parameters.forms import FORMS, NODE, Written

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.plan.model import Process
    from orchestra.values import ParameterValue

# What YAML 1.1, YAML 1.2, PyYAML and rcl's C parser read differently when it is not in quotes.
_TREACHEROUS = (
    *("y", "n", "Y", "N", "yes", "no", "on", "off", "true", "True", "null", "~", ""),
    *("1", "-1", "+1", "0452", "0x1F", "0o17", "0b11", "1_000", "12:30", "190:20:30.15"),
    *("1.0", "1.", ".5", "1e3", "1e-6", "123E5", "nan", "NaN", ".nan", "inf", ".inf", "-.Inf", "Infinity"),
    *("2024-01-01", "=", "<<", "-", "?", ":", "a: b", "a #b", "#a", "[1, 2]", "{a: 1}", "&a", "*a", "!a"),
    *("%d", "@x", "`x`", "'", '"', "'1'", '"1"', "\\", "\\n", " a ", "a\nb", "\t", "| a", "> a"),
    *("$HOME", "$(var x)", "$(", "$$", "é", "😀", "\u2028", "\x85", "\ufeff", "a,b", "a;b"),
)
_NOT_IN_XML = "[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]"
_LEAST, _MOST = -(2**63), 2**63 - 1
_TEXTS = st.sampled_from(_TREACHEROUS) | st.text(
    st.characters(exclude_categories=["Cs"], exclude_characters="\0"), max_size=12
)
_SCALARS = (
    st.booleans(),
    st.sampled_from([0, 1, -1, 8, _LEAST, _MOST]) | st.integers(_LEAST, _MOST),
    st.sampled_from([0.0, -0.0, 1.0, 1e16, 1e300, 5e-324, math.inf, -math.inf, math.nan]) | st.floats(),
    _TEXTS,
)
VALUES = st.one_of(*_SCALARS, *(st.lists(kind, min_size=1, max_size=4).map(tuple) for kind in _SCALARS))


def _planned(folder: Path, written: Written) -> Process:
    for name, text in {written.name: written.text, **written.beside}.items():
        (folder / name).write_text(text, "utf-8", newline="")
    problems = Problems()
    with chdir(folder):
        inputs = inputs_from(written.words, environment=os.environ, params_files=written.params_files)
        plan = collect(str(folder / written.name), inputs, problems)
    assert not problems.errors, (written.text, written.words, list(problems))
    assert plan is not None
    return plan.processes[0]


def _arrived(ask_rcl: Callable[..., Any], process: Process) -> dict[str, Any]:
    """Return the parameters of a real node that is given the ROS arguments of a planned process."""
    files = contents(process)
    words = process.command[process.command.index("--ros-args") :]
    arguments = [[files[word]] if word in files else word for word in words]
    answer: dict[str, Any] = ask_rcl("node", arguments=arguments)
    assert "parameters" in answer, (answer, words, files)
    assert answer["name"] == NODE
    return dict(answer["parameters"])


def _same(found: Any, value: ParameterValue) -> bool:
    """Compare with types and the sign of zero; every NaN is NaN."""
    if isinstance(value, tuple):
        return isinstance(found, list) and len(found) == len(value) and all(map(_same, found, value))
    if isinstance(value, float) and math.isnan(value):
        return isinstance(found, float) and math.isnan(found)
    return type(found) is type(value) and repr(found) == repr(value)


def _sayable(form: str, value: ParameterValue) -> bool:
    """XML 1.0 has no way to write most control characters."""
    return (
        "xml" not in form
        or "file" in form
        or not re.search(_NOT_IN_XML, "".join(map(str, value)) if isinstance(value, tuple) else str(value))
    )


def _check(ask_rcl: Callable[..., Any], form: str, value: ParameterValue) -> None:
    with TemporaryDirectory() as folder:
        written = FORMS[form](value)
        parameters = _arrived(ask_rcl, _planned(Path(folder), written))
    (found,) = parameters.values()
    assert _same(found, value), (found, value, written.text, written.words, written.beside)


@pytest.mark.parametrize("form", FORMS)
def test_a_treacherous_text_stays_that_text(ask_rcl: Callable[..., Any], form: str) -> None:
    _check(ask_rcl, form, tuple(text for text in _TREACHEROUS if _sayable(form, text)))


@pytest.mark.parametrize("form", FORMS)
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=12,
)
@given(value=VALUES)
def test_any_value_arrives(ask_rcl: Callable[..., Any], form: str, value: ParameterValue) -> None:
    assume(_sayable(form, value))
    _check(ask_rcl, form, value)


@pytest.mark.long
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("form", FORMS)
@settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    deadline=None,
    max_examples=1_000,
)
@given(value=VALUES)
def test_any_of_many_values_arrives(ask_rcl: Callable[..., Any], form: str, value: ParameterValue) -> None:
    assume(_sayable(form, value))
    _check(ask_rcl, form, value)

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.description.substitutions import SIGNATURES
from orchestra.description.written import escaped
from orchestra.errors import Code
from orchestra.location import point
from orchestra.resolve.context import POISON, Value
from orchestra.resolve.evaluate import evaluate
from orchestra.resolve.substitutions.equality import equal
from orchestra.resolve.substitutions.table import SUBSTITUTIONS

if TYPE_CHECKING:
    from tests.resolve.texts.conftest import Place

_PROBES = [
    json.loads(line)
    for line in Path(__file__).parents[2].joinpath("data/launch-probes.jsonl").read_text("utf-8").splitlines()
]
# Where upstream is at fault: it takes a single space only, and keeps the last line break of what a command prints.
_DIFFERENT_HERE = {
    "$(var  a)": "A",
    "$( var a)": "A",
    "$(var a )": "A",
    '$(command "echo hi")': "hi",
    "$(command 'echo hi')": "hi",
    # Names of later releases.
    "$(path-join a b)": "a/b",
    "$(string-join a b)": "b",
}


@pytest.mark.parametrize(
    "probe", [probe for probe in _PROBES if probe["k"] == "subst"], ids=lambda probe: probe["in"]
)
def test_what_upstream_evaluates_evaluates_to_the_same(probe: dict[str, Any], place: Place) -> None:
    text = probe["in"]
    expected = _DIFFERENT_HERE.get(text, probe.get("out"))
    assert place.value(text) == expected
    assert bool(place.problems.errors) == (expected is None)


def _as_text(value: object) -> str:
    """Read a Python value as upstream's EqualsSubstitution does."""
    match value:
        case None:
            return ""
        case bool():
            return str(value).lower()
        case _:
            return str(value)


@pytest.mark.parametrize(
    "probe", [probe for probe in _PROBES if probe["k"] == "equals"], ids=lambda probe: probe["in"]
)
def test_what_upstream_finds_equal_is_equal(probe: dict[str, Any]) -> None:
    left, right = map(_as_text, probe["in"])
    assert equal(left, right) == (probe["out"] == "true")


def test_every_substitution_that_can_be_written_can_be_performed() -> None:
    assert set(SUBSTITUTIONS) == set(SIGNATURES)


def test_a_value_points_at_what_is_written_not_at_what_it_came_from(place: Place) -> None:
    included = (point("main.yaml", 7, 3),)
    place.context = replace(place.context, included_from=included)
    template = place.write("x $(var a)")
    value = evaluate(template, place.context)
    assert isinstance(value, Value)
    assert (value.text, value.location.span, value.location.included_from) == ("x A", template.span, included)


def test_poison_flows_on_in_silence(place: Place) -> None:
    for text in [
        "x $(var poisoned)",
        "$(var $(var poisoned))",
        "$(env $(var poisoned) default)",
        "$(var missing $(var poisoned))",
        "$(param $(var poisoned))",
        "$(eval '$(var poisoned) +')",
        "$(command '$(var poisoned)')",
        "$(find-pkg-share $(var poisoned))",
        "$(exec-in-pkg x $(var poisoned))",
        "$(find-exec $(var poisoned))",
        "$(file-content $(var poisoned))",
        "$(anon $(var poisoned))",
        "$(not $(var poisoned))",
        "$(and $(var poisoned) true)",
        "$(equals a $(var poisoned))",
        "$(not-equals a $(var poisoned))",
        "$(if $(var poisoned) a b)",
        "$(if true $(var poisoned))",
    ]:
        assert place.value(text) is None
    assert not len(place.problems)


def test_all_faults_of_a_text_are_told_at_once(place: Place) -> None:
    assert (
        place.value("$(nosuch $(var b)) $(var missing) $(env NOPE) $(equals $(var gone) $(var lost))") is None
    )
    assert [place.stretch(problem.span) for problem in place.problems.ordered] == [
        "nosuch",
        "missing",
        "NOPE",
        "gone",
        "lost",
    ]


def test_a_variable_read_by_a_faulty_text_counts_as_read(place: Place) -> None:
    place.value("$(nosuch $(var a))")
    assert "a" in place.scope.ledger.read


def test_a_fault_tells_the_includes_that_led_to_it(place: Place) -> None:
    included = (point("main.yaml", 7, 3),)
    place.context = replace(place.context, included_from=included)
    problem = place.refusal("$(var missing)")
    assert (problem.code, problem.included_from) == (Code.UNDEFINED_VARIABLE, included)


def test_the_deepest_nesting_is_evaluated(place: Place) -> None:
    place.set("A", "a")
    assert place.value("$(var " * 50 + "a" + ")" * 50) == "a"


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow])
@given(st.text())
def test_an_escaped_text_evaluates_to_itself(place: Place, text: str) -> None:
    assert place.value(escaped(text)) == text
    place.set("any", text)
    assert place.value("<$(var any)>") == f"<{text}>"


def test_poison_is_told_from_any_value(place: Place) -> None:
    assert evaluate(place.write("$(var poisoned)"), place.context) is POISON

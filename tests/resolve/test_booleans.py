from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.resolve.booleans import boolean

_PROBES = [
    json.loads(line)
    for line in Path(__file__).parents[1].joinpath("data/launch-probes.jsonl").read_text("utf-8").splitlines()
]
# Upstream's conditions refuse what its boolean substitutions accept; here one rule reads both.
_ACCEPTED_HERE = {"yes": True, "on": True}


@pytest.mark.parametrize(
    "probe", [probe for probe in _PROBES if probe["k"] == "bool"], ids=lambda probe: probe["in"]
)
def test_booleans_are_read_as_upstream_reads_them(probe: dict[str, object]) -> None:
    assert boolean(str(probe["in"])) == probe.get("out")


@pytest.mark.parametrize(
    "probe", [probe for probe in _PROBES if probe["k"] == "if"], ids=lambda probe: probe["in"]
)
def test_conditions_are_read_as_upstream_reads_them_or_more_kindly(probe: dict[str, object]) -> None:
    text = str(probe["in"])
    assert boolean(text) == probe.get("out", _ACCEPTED_HERE.get(text))


@pytest.mark.parametrize(
    "text", ["", " ", "y", "n", "t", "2", "-1", "01", "1.0", "None", "true false", "tru"]
)
def test_anything_else_is_no_boolean(text: str) -> None:
    assert boolean(text) is None


@given(
    st.sampled_from(["1", "true", "yes", "on", "0", "false", "no", "off"]),
    st.text(alphabet=" \t\n", max_size=3),
)
def test_case_and_blanks_around_do_not_matter(word: str, blanks: str) -> None:
    assert (
        boolean(blanks + word.upper() + blanks)
        == boolean(word.title())
        == (word in ("1", "true", "yes", "on"))
    )

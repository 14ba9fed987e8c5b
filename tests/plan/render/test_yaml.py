"""Plans as YAML."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan import codec
from orchestra.plan.render import yaml_text
from orchestra.plan.render.formats import FORMATS
from tests.plan.records import node, plan, words
from tests.plan.strategies import Actions, descriptions

if TYPE_CHECKING:
    from pathlib import Path


@given(descriptions)
@settings(
    max_examples=25,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
def test_it_is_the_same_data_as_json_and_reads_back_as_the_same_plan(
    tmp_path: Path, written: Actions
) -> None:
    (tmp_path / "main.launch.yaml").write_text(json.dumps({"launch": written}))
    made = collect(str(tmp_path / "main.launch.yaml"), inputs_from([], environment={}), Problems())
    assert made is not None
    text = FORMATS["yaml"](made)
    assert codec.dumps(yaml_text.loads(text)) == codec.dumps(made)
    assert yaml.safe_load(text) == json.loads(FORMATS["json"](made))


_values = st.one_of(
    words,
    st.integers(),
    st.floats(allow_nan=False),
    st.booleans(),
    st.lists(words, min_size=1, max_size=3).map(tuple),
    st.sampled_from(["yes", "0o7", "1e3", "12:30", "null", "~", "<<", "=", "2026-11-21", "0x1F", "1_000"]),
)


@given(_values, words)
@settings(max_examples=150, deadline=None)
def test_every_value_keeps_its_type(value: Any, word: str) -> None:
    made = plan(node("/a", "x", word, parameters={"p": value}))
    again = yaml_text.loads(FORMATS["yaml"](made))
    assert codec.dumps(again) == codec.dumps(made)


@pytest.mark.parametrize("text", ["[", "version: 0\n", "launch: []\n", "version: 1\nfile: x\n", "- 1\n"])
def test_other_documents_are_refused(text: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 - which words it says is the parser's
        yaml_text.loads(text)

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
from orchestra.plan.render.yaml_lines import document
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


_FOLDED = ("\x85", "\u2028", "\u2029", "\ufeff")


class _Dumper(yaml.SafeDumper):
    """PyYAML's own, but for texts with line breaks that it would fold."""

    def represent_str(self, data: str) -> yaml.ScalarNode:
        style = '"' if any(mark in data for mark in _FOLDED) else None
        return self.represent_scalar("tag:yaml.org,2002:str", data, style)


_Dumper.add_representer(str, _Dumper.represent_str)
_TEXTS = st.one_of(
    st.text(max_size=8),
    st.text("ab -:#,{}[]?!&*'\"%@`~=<>|.0123\n\t$/_\\", max_size=12),
    st.sampled_from(
        ["yes", "No", "NULL", "-r", "---", "--- a", "1e3", "a:", "a: b", "a #b", "\n", "a\u2028b"]
    ),
    st.sampled_from(
        ["x " * 80, "y" * 130, "_" * 127, "--x " * 60, "l1\n\nl2\n", "ä€\U0001f600", "${run}/x.yaml"]
    ),
)
_DATA = st.recursive(
    st.one_of(_TEXTS, st.none(), st.booleans(), st.integers(), st.floats()),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(_TEXTS, inner, max_size=4),
    max_leaves=20,
)


@given(st.dictionaries(_TEXTS, _DATA, max_size=5))
@settings(max_examples=200, deadline=None)
def test_it_is_what_the_library_writes(data: dict[str, Any]) -> None:
    dumped = yaml.dump(data, Dumper=_Dumper, allow_unicode=True, sort_keys=False, width=110)
    assert document(data) == dumped

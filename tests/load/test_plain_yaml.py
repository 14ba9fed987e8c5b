"""A plain YAML file is read in one pass, and to the same tree as any other; what is not plain is left alone."""

from __future__ import annotations

from typing import Any

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.description.source import Keyed, Listed, Written
from orchestra.errors import Problems
from orchestra.load import yaml_plain
from orchestra.load.offsets import source
from orchestra.load.reader import Reader
from orchestra.load.yaml_file import read_closely

_WORDS = st.text("ab1 :#-,'\"\\\n\t[]{}$()<~ü\u2028😀", max_size=12)
_TREES = st.recursive(
    _WORDS | st.none() | st.booleans() | st.integers(),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(_WORDS, inner, max_size=4),
    max_leaves=12,
)
_STYLES = st.sampled_from([None, "'", '"', "|", ">"])
_FLOWS = st.sampled_from([None, True, False])


def _whole(tree: Any) -> Any:
    """Return everything that is known of a tree, places of parts of its texts included."""
    if isinstance(tree, Written):
        parts = [tree.spans(at, at + 1) for at in range(len(tree.text))]
        return (tree.text, tree.span, tree.inside, parts, tree.quoted, tree.null)
    if isinstance(tree, Listed):
        return (tree.span, [_whole(item) for item in tree])
    assert isinstance(tree, Keyed)
    items = [(key, tree.keys_at[key], _whole(value)) for key, value in tree.items()]
    return (tree.span, tree.head, items, tree.lossy, tree.meant)


def _both(text: str) -> tuple[Any, Any, Problems]:
    """Return the tree of one pass, None without one, that of a close look, and what this reports."""
    problems = Problems()
    plain = yaml_plain.read(source("a.yaml", text))
    close = read_closely(source("a.yaml", text), Reader(problems))
    return (None if plain is None else _whole(plain)), (None if close is None else _whole(close)), problems


@settings(deadline=None)  # a busy machine is no fault
@given(_TREES, _STYLES, _FLOWS, st.integers(40, 90))
def test_the_tree_is_that_of_a_close_look(tree: Any, style: str | None, flow: Any, width: int) -> None:
    text = yaml.safe_dump(tree, default_style=style, default_flow_style=flow, width=width, allow_unicode=True)
    plain, close, problems = _both(text)
    assert plain is None or (plain == close and not problems)
    odd = any(sign in text for sign in ("!", "<", "-", "...", "%"))
    assert plain is not None or problems or odd


@settings(deadline=None)  # a busy machine is no fault
@given(st.text("ab: -\n[]{},'\"#|>&*!<?~\t\r\x85\u2028", max_size=40))
def test_any_text_has_the_same_tree_or_none(text: str) -> None:
    plain, close, problems = _both(text)
    assert plain is None or (plain == close and not problems)


@pytest.mark.parametrize(
    "text",
    [
        "a: &x 1\nb: *x\n",
        "a: &x 1\n",
        "a: !!str 1\n",
        "a: !!map {b: 1}\n",
        "!!str a: 1\n",
        "&x a: 1\n",
        "a: {<<: {b: 1}}\n",
        "a: 1\na: 2\n",
        "[a]: 1\n",
        "-a: 1\n",
        "a: 1\n---\nb: 1\n",
        "a: [1\n",
        "",
        "[" * 101 + "]" * 101,
    ],
)
def test_what_calls_for_a_second_look_is_left_alone(text: str) -> None:
    assert yaml_plain.read(source("a.yaml", text)) is None


def test_signs_of_anchors_and_tags_within_texts_are_plain() -> None:
    plain, close, problems = _both("a: 'b & c'\nd: $(eval \"1 != 2 * 3\")\ne: [x&y, z!]\n")
    assert plain == close is not None
    assert not problems

"""What a matched text comes to is, to everybody, the value that says the same."""

from __future__ import annotations

import copy
import re

import pytest

from orchestra.description.text import MatchedTemplate, PlainCall, matched_template, matched_words, pieces_of
from orchestra.fields import replace
from orchestra.load.offsets import source
from orchestra.location import Location, Matched, Span
from orchestra.resolve.context import Read, Value
from orchestra.resolve.late_values import matched_value

_TEXT = "launch: \n- arm $(dirname)"
_CHAIN = (Span("top.yaml", 3, 5, 3, 9),)


def _values() -> list[tuple[Value, Value]]:
    """Return values of matched texts, each with the ordinary one that says the same."""
    whole = source("a.yaml", _TEXT)
    found = re.search(r"- (arm) (\S+)", _TEXT)
    assert found is not None
    matched = Matched(whole, found)
    words = matched_words("arm", False, matched, 1)
    assert isinstance(words, MatchedTemplate)
    place, other = Location(matched.span(1), _CHAIN), Location(matched.span(2), _CHAIN)
    called = matched_template(
        "$(dirname)", False, matched, 2, pieces_of([PlainCall("dirname", (), 10, None)])
    )
    assert isinstance(called, MatchedTemplate)
    through = (Read("variable", "x", "y", "let", place),)
    return [
        (matched_value("arm", words, _CHAIN), Value("arm", place, verbatim=True)),
        (
            matched_value("/home", called, _CHAIN, through),
            Value("/home", other, through=through, raw=called.raw),
        ),
    ]


@pytest.mark.parametrize("which", [0, 1])
def test_a_matched_value_is_like_the_ordinary_one(which: int) -> None:
    matched, ordinary = _values()[which]
    assert matched == ordinary
    assert ordinary == matched
    assert hash(matched) == hash(ordinary)
    assert repr(matched) == repr(ordinary)
    for field in ("text", "location", "through", "verbatim", "raw"):
        assert getattr(matched, field) == getattr(ordinary, field)
    assert matched != replace(ordinary, text="leg")


@pytest.mark.parametrize("which", [0, 1])
def test_copies_and_changes_of_a_matched_value_are_ordinary(which: int) -> None:
    matched, ordinary = _values()[which]
    changed = replace(matched, text="leg")
    for made in (copy.copy(matched), copy.deepcopy(matched), changed):
        assert type(made) is Value
        assert (made.location, made.through, made.verbatim, made.raw) == (
            ordinary.location,
            ordinary.through,
            ordinary.verbatim,
            ordinary.raw,
        )
    assert copy.copy(matched) == matched
    assert changed.text == "leg"

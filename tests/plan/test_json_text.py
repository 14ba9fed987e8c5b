from __future__ import annotations

import json
import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.errors import Code, Problem, Severity
from orchestra.location import Location, Span, point
from orchestra.plan import codec
from orchestra.plan.json_text import text_of
from orchestra.plan.model import Candidate, ParameterFile, Provenance, Via
from orchestra.values import Limits

_TEXTS = st.text(max_size=6) | st.sampled_from(["a\nb", '"', "\\", "\x7f", "\u2028", "ärm", "\ud800"])
_SCALARS = (
    _TEXTS | st.integers() | st.floats() | st.booleans() | st.none() | st.sampled_from([math.inf, -math.inf])
)
_SPANS = st.builds(Span, _TEXTS, *[st.integers(1, 99)] * 4)
_PLACES = st.builds(Location, _SPANS, st.lists(_SPANS, max_size=2).map(tuple))
_VIAS = st.builds(Via, st.just("variable"), _TEXTS, _TEXTS, _TEXTS, st.none() | _PLACES, st.integers(0, 3))
_CANDIDATES = st.builds(
    Candidate, _SCALARS, _PLACES, st.booleans(), _TEXTS, st.lists(_VIAS, max_size=2).map(tuple)
)
_PROBLEMS = st.builds(
    Problem,
    st.sampled_from(Code),
    st.sampled_from(Severity),
    _TEXTS,
    st.none() | _SPANS,
    st.lists(_SPANS, max_size=2).map(tuple),
    st.none() | _TEXTS,
    st.lists(_TEXTS, max_size=2).map(tuple),
)
_RECORDS = st.one_of(
    _SCALARS,
    _CANDIDATES,
    _PROBLEMS,
    st.builds(ParameterFile, _TEXTS, _TEXTS),
    st.builds(
        Limits, cores=st.lists(st.integers(), max_size=2).map(tuple), rlimits=st.just({"core": (0, -1)})
    ),
    st.builds(
        Provenance,
        name=st.none() | _PLACES,
        parameters=st.dictionaries(_TEXTS, st.lists(_CANDIDATES, max_size=2).map(tuple), max_size=2),
        remappings=st.lists(_PLACES, max_size=2).map(tuple),
        remapping_values=st.lists(st.lists(_VIAS, max_size=1).map(tuple), max_size=2).map(tuple),
    ),
)
_VALUES = st.recursive(
    _RECORDS,
    lambda inner: (
        st.lists(inner, max_size=3) | st.tuples(inner, inner) | st.dictionaries(_TEXTS, inner, max_size=3)
    ),
    max_leaves=6,
)


@given(_VALUES, st.sampled_from([None, 2, 4]))
def test_the_text_is_the_one_that_json_makes_of_the_data(value: Any, indent: int | None) -> None:
    assert text_of(value, indent) == json.dumps(codec.encode(value), indent=indent, ensure_ascii=False)


def test_what_json_has_no_words_for_is_refused() -> None:
    with pytest.raises(TypeError, match="not JSON serializable"):
        text_of([object()])


def test_what_is_read_again_shares_its_includes() -> None:
    chain = (point("outer.yaml", 3),)
    places = [Location(point("inner.yaml", line), chain) for line in (1, 2)]
    one, other = codec.decode(tuple[Location, ...], json.loads(text_of(places)))
    assert (one, other) == tuple(places)
    assert one.included_from is other.included_from

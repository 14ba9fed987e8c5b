"""Sections found by a node's name are those that match it, in order, without a look at all of them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hypothesis import given
from hypothesis import strategies as st

from orchestra.location import Location, Span
from orchestra.resolve.rcl import indexed
from orchestra.resolve.rcl.indexed import Indexed
from orchestra.resolve.rcl.patterns import matches
from orchestra.resolve.rcl.sections import Section

if TYPE_CHECKING:
    from collections.abc import Sequence

    import pytest

_PATTERNS = st.lists(
    st.lists(st.sampled_from(["a", "b", "*", "**"]), min_size=1, max_size=5).map("/".join), max_size=30
)
_NAMES = st.lists(st.sampled_from("abc"), min_size=1, max_size=5).map(lambda parts: "/" + "/".join(parts))


def _indexed(patterns: Sequence[str]) -> Indexed:
    place = Location(Span("params.yaml", 1, 1, 1, 2))
    return Indexed([Section(pattern, (), place) for pattern in patterns])


@given(_PATTERNS, _NAMES)
def test_what_is_found_is_what_matches(patterns: list[str], name: str) -> None:
    for written in (patterns, [f"/{pattern}" for pattern in patterns]):
        index = _indexed(written)
        wanted = [pattern for pattern in written if matches(pattern, name)]
        assert [section.pattern for section in index.matching(name)] == wanted
        assert index.has_wildcard_for(name) == any("*" in pattern for pattern in wanted)


def test_of_a_thousand_patterns_those_of_the_namespace_are_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    tried = list[str]()

    def counted(pattern: str, name: str) -> bool:
        tried.append(pattern)
        return matches(pattern, name)

    monkeypatch.setattr(indexed, "matches", counted)
    robots = range(250)
    patterns = [
        f"{robot}{rest}"
        for number in robots
        for robot in (f"/robots/r{number}",)
        for rest in ("/*", "/**", "/*/n")
    ]
    index = _indexed([*patterns, "/**"])
    for number in robots:
        found = [section.pattern for section in index.matching(f"/robots/r{number}/n")]
        assert found == [f"/robots/r{number}/*", f"/robots/r{number}/**", "/**"]
    assert len(tried) <= 4 * len(robots)

"""Names that a word is mistyped for, among many: the same as by a look at each."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from orchestra.resolve.typos import is_typo
from orchestra.resolve.typos_among import Names

_KNOWN = (
    "front_lidar",
    "rear_lidar",
    "camera1",
    "camera_12",
    "controller_server",
    "Planner-Server",
    "node",
    "",
)
_EDITS = st.lists(
    st.tuples(st.integers(0, 20), st.sampled_from(["", "_", "-", "a", "R", "1", "ee"])), max_size=4
)


@given(st.sampled_from(_KNOWN), _EDITS)
def test_the_same_names_are_found_as_by_a_look_at_each(word: str, edits: list[tuple[int, str]]) -> None:
    for place, text in edits:
        word = word[:place] + text + word[place + 1 :]
    assert sorted(Names(_KNOWN).meant_by(word)) == sorted(name for name in _KNOWN if is_typo(word, name))


def test_slips_are_found() -> None:
    assert Names(_KNOWN).meant_by("controler_server") == ["controller_server"]
    assert Names(_KNOWN).meant_by("planner_server") == ["Planner-Server"]
    assert Names(_KNOWN).meant_by("camera2") == []

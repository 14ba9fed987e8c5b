"""What is read by a look at all of a text is what is read character by character."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from orchestra.description.substitutions import SIGNATURES
from orchestra.errors import Problems
from orchestra.load import grammar, repeated
from orchestra.load.plain_calls import plain_shape
from orchestra.location import Span

if TYPE_CHECKING:
    from orchestra.description.text import Template

_PIECES = st.sampled_from(
    [
        *("$(", ")", "(", " ", "  ", "$", "\\", "'", '"', "\n", "\t", "/", "é", "{", "-", "a", "b0", "_"),
        *(f"$({name}" for name in SIGNATURES),
        *("$(var a)", "$(dirname)", "$(env HOME x)", "$(nobody knows)"),
    ]
)


def _closely(text: str) -> tuple[Template, int]:
    found = Problems()
    template = grammar.by_itself(text, lambda first, last: Span("", 1, first, 1, last), found)
    return template, len(found)


_TEXTS = st.lists(_PIECES, max_size=8).map("".join)
_QUOTED = st.tuples(st.sampled_from(["$(eval ", "$(env ", "$(nobody "]), st.sampled_from("'\""), _TEXTS)


@given(_TEXTS | _QUOTED.map(lambda parts: f"{parts[0]}{parts[1]}{parts[2]}{parts[1]})"))
@example("$(eval \"'$(var mode)' == 'sim'\")")
@example("$(eval '')")
@example("$(eval '$(var)')")
@example("$(eval '1' '2')")
@example("$(dirname '')")
@example("$(var a b)x")
@example("$(var)")
@example("$(if a b c d)")
@example("$(all)$(all a b c)")
@example("$(dirname )")
def test_both_ways_give_the_same(text: str) -> None:
    plain = plain_shape(text)
    if plain is not None:
        template, problems = _closely(text)
        assert not problems
        assert not template.faulty
        assert repeated._shape(template) == plain


@pytest.mark.parametrize(
    "text",
    [
        "$(var robot)/base",
        "/$(var a)/$(var b)",
        "$(dirname)/a b.yaml",
        "$(find-pkg-share pkg)/x",
        "$(env A b)",
        "$(eval \"'$(var mode)' == 'sim'\")",
        "$(eval '3 >= $(var n)')",
    ],
)
def test_what_most_files_write_takes_no_closer_look(text: str) -> None:
    assert plain_shape(text) is not None

"""What stands in the slots of a text is found part by part as it is by going through it from slot to slot."""

from __future__ import annotations

import random

import pytest

from orchestra.resolve.python.form_slots import QUOTES, split
from orchestra.resolve.python.form_texts import FormText, _values

_TEXTS = {
    "one slot a part": 'f(name="a1", rate=2.5, frame="b1")\ng("c1", 7)\n',
    "of the other quotes": "f(name='a1', rate=2.5, frame=\"b1\")\ng('c1', 7)\n",
    "several slots a part": 'f(name="a1", rates=[2.5, 3.5, -1], frame="b1")\n',
    "a comment": 'f(name="a1")  # the 1st\ng("c1", 7)\n',
    "no quotes": "f(1, 2)\ng(3)\n",
}
_WRITTEN = ('"', "'", ",", ", ", ")", "2.5", "x", "", "12", "\n", "#", "a1", " ", "]", "rate=", "-1")


@pytest.mark.parametrize("text", _TEXTS.values(), ids=_TEXTS.keys())
def test_what_stands_in_slots_is_what_stands_between_the_pieces(text: str) -> None:
    rng = random.Random(1)  # noqa: S311 - nothing secret
    parts = split(text)
    places = {index: None if literal[0] == "#" else "" for index, literal in enumerate(parts[1::2])}
    form = FormText(parts, places)
    found = form.values(text)
    assert found is not None
    assert len(found) == list(places.values()).count("")
    same = 0
    for _ in range(2000):
        changed = parts.copy()
        for _ in range(rng.choice((1, 1, 2, 4))):
            index = rng.randrange(len(changed))
            literal = changed[index]
            inside = literal[:1] + rng.choice(_WRITTEN) + literal[1:2] if index % 2 else rng.choice(_WRITTEN)
            changed[index] = inside if rng.random() < 1 / 2 or index % 2 else literal
        other = "".join(changed)
        expected = _values(other, form._pieces, form._end)
        values = form.values(other)
        same += values is not None
        if values is not None and None not in places.values():
            assert values == expected, other
        is_left = expected is not None and any(quote in "".join(expected) for quote in QUOTES)
        assert values is not None or expected is None or is_left or "#" in text  # to the compiler
    assert same

"""What stands in the slots of a text is found by one match as it is by going through it from slot to slot."""

from __future__ import annotations

import random

import pytest

from orchestra.resolve.python.form_slots import split
from orchestra.resolve.python.form_texts import FormText, _pieces

_TEXTS = {
    "one slot a part": 'f(name="a1", rate=2.5, frame="b1")\ng("c1", 7)\n',
    "of the other quotes": "f(name='a1', rate=2.5, frame=\"b1\")\ng('c1', 7)\n",
    "several slots a part": 'f(name="a1", rates=[2.5, 3.5, -1], frame="b1")\n',
    "equal ones": 'f(name="a1", of="a1", rates=[2, 3, 2], frames=["a1", "b"])  # 1\n# two\n',
    "a comment": 'f(name="a1")  # the 1st\ng("c1", 7)\n',
    "no quotes": "f(1, 2)\ng(3)\n",
}
_WRITTEN = (
    '"',
    "'",
    ",",
    ", ",
    ")",
    "2.5",
    "x",
    "",
    "12",
    "\n",
    "#",
    "a1",
    " ",
    "]",
    "rate=",
    "-1",
    "coding",
)


@pytest.mark.parametrize("text", _TEXTS.values(), ids=_TEXTS.keys())
def test_what_stands_in_slots_is_what_stands_between_the_pieces(text: str) -> None:
    rng = random.Random(1)  # noqa: S311 - nothing secret
    parts = split(text)
    places = {index: None if literal[0] == "#" else "" for index, literal in enumerate(parts[1::2])}
    numbers = _numbers(parts[1::2])
    form = FormText(parts, places, numbers)
    assert form.values(text) is not None
    same = 0
    for _ in range(2000):
        changed = parts.copy()
        for _ in range(rng.choice((1, 1, 2, 4))):
            index = rng.randrange(len(changed))
            literal = changed[index]
            inside = literal[:1] + rng.choice(_WRITTEN) + literal[1:2] if index % 2 else rng.choice(_WRITTEN)
            changed[index] = inside if rng.random() < 1 / 2 or index % 2 else literal
            for alike, number in enumerate(numbers if index % 2 and rng.random() < 1 / 2 else ()):
                if number == numbers[index // 2]:
                    changed[2 * alike + 1] = changed[index]
        other = "".join(changed)
        expected = _expected(parts, places, numbers, other)
        assert form.values(other) == expected, other
        same += expected is not None
    assert same


def _numbers(literals: list[str]) -> list[int]:
    """Return for each literal which one it is of those that differ, comments last, all of which do."""
    named = [(literal[0] == "#" and index + 1, literal) for index, literal in enumerate(literals)]
    order = sorted(dict.fromkeys(named), key=lambda name: name[0])
    return list(map(order.index, named))


def _expected(
    parts: list[str], places: dict[int, str | None], numbers: list[int], text: str
) -> tuple[str, ...] | None:
    """Return what stands in the slots of a text, by going through it."""
    pieces, end = _pieces(parts, places)
    found: dict[int, str] = {}
    at = 0
    for (piece, stop), number, before in zip(pieces, numbers, places.values(), strict=True):
        if not text.startswith(piece, at):
            return None
        at += len(piece)
        behind = text.find(stop, at)
        if behind < 0 or found.setdefault(number, text[at:behind]) != text[at:behind]:
            return None
        if before is None and "coding" in found.pop(number):
            return None
        at = behind
    return tuple(found[number] for number in sorted(found)) if text[at:] == end else None

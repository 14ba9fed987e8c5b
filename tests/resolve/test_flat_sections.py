"""What counts of sections where no name can take another's slot is what rcl's table makes of them."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

from orchestra.errors import Problems
from orchestra.resolve.rcl.files import read_parameter_file
from orchestra.resolve.rcl.table import flat, tabulated

if TYPE_CHECKING:
    from orchestra.resolve.rcl.sections import Section

_KEYS = ("a", "b", "c", "a.b", "c.d", "e")
_VALUES = ("1", "2.5", "true", "x", "[1, 2]", "[a]", "'1'")


def _parameters(rnd: Random, depth: int = 3) -> list[str]:
    lines = []
    for key in rnd.sample(_KEYS, rnd.randrange(1, 4)):
        pad = " " * 2 * (5 - depth)
        if depth and rnd.random() < 0.3:
            lines += [f"{pad}{key}:", *_parameters(rnd, depth - 1)]
        else:
            lines.append(f"{pad}{key}: {rnd.choice(_VALUES)}")
    return lines


def _sections(rnd: Random) -> list[Section]:
    found: list[Section] = []
    for _ in range(rnd.randrange(1, 4)):
        text = "\n".join([f"{rnd.choice(('/**', 'n', '/n'))}:", "  ros__parameters:", *_parameters(rnd)])
        found += read_parameter_file(text, "p.yaml", Problems())
    return found


def test_sections_are_told_apart_as_by_the_table() -> None:
    rnd, plain = Random(11), 0  # noqa: S311 - the same every time
    for _ in range(400):
        sections = _sections(rnd)
        told = flat(sections)
        if told is None:
            continue
        plain += 1
        table = {
            pattern: [(slot.name, slot.entry) for slot in slots]
            for pattern, slots in tabulated(sections).items()
        }
        assert {pattern: list(entries.items()) for pattern, entries in told.items()} == table
        assert flat(sections) == told  # as from what is known of each
    assert 100 < plain < 390

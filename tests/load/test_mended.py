"""Texts that are read as they were meant: their places are those of the file, and it takes no longer than it is worth."""

from __future__ import annotations

import random
from time import process_time
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Problems
from orchestra.load.carrying_on import description_behind
from orchestra.load.mended import mended
from orchestra.load.offsets import source
from orchestra.load.reader import Reader

if TYPE_CHECKING:
    from orchestra.description.launch import Description

_YAML = "launch:\n  - node: {pkg: a, exec: b}\n%s\n  - node: {pkg: a, exec: b, name: c}\n"
_XML = '<launch>\n  <node pkg="a" exec="b"/>\n%s\n  <node pkg="a" exec="b"/>\n</launch>\n'


def _behind(text: str) -> Description | None:
    language = "xml_file" if text.startswith("<") else "yaml_file"
    return description_behind(text, "/f", "f", language, Reader(Problems(), (), text))


def test_many_edits_give_what_they_give_one_by_one() -> None:
    chance = random.Random(3)  # noqa: S311 - the same each time
    for _ in range(500):
        text = "".join(chance.choice("ab\n") for _ in range(30))
        offsets = sorted(chance.sample(range(31), 6))
        edits = [
            (begin, chance.choice((begin, end)), chance.choice(("", "x", "yyyy\n")))
            for begin, end in zip(offsets[::2], offsets[1::2], strict=True)
        ]
        together, one_by_one = mended(source("f", text), edits), source("f", text)
        for edit in reversed(edits):
            one_by_one = mended(one_by_one, [edit])
        assert together.text == one_by_one.text
        places = range(len(together.text) + 1)
        assert [together.place(at) for at in places] == [one_by_one.place(at) for at in places], (text, edits)


def test_each_line_may_have_a_tab() -> None:
    description = _behind(_YAML % "\n".join(["\t- node: {pkg: a, exec: b}"] * 1500))
    assert description is not None
    assert len(description.actions) == 1502


@pytest.mark.parametrize(
    "text",
    {
        "closing brackets": _YAML % f'  - node: {{pkg: "x{"],}" * 13_000}y',
        "commas": _YAML % f'  - node: {{pkg: "x{"," * 40_000}y',
        "a conflict without an end": _YAML % ("<<<<<<< HEAD\n" + "=======\n" * 20_000),
        "blanks in YAML": _YAML % f'  - node: {{pkg: "x{" " * 40_000}y',
        "blanks in XML": _XML % f'  <node pkg="x{" " * 40_000}y',
        "many ways, with much to be read": _YAML
        % "\n".join(
            [
                *['  - node: {pkg: a, exec: b, param: [{name: x, value: "$(var z)"}]}'] * 500,
                f'  - node: {{pkg: "a, {", ".join(f"e{number}: b" for number in range(40))}}}',
            ]
        ),
    }.items(),
    ids=lambda item: item[0],
)
def test_what_cannot_be_mended_soon_is_left(text: tuple[str, str]) -> None:
    begin = process_time()
    _behind(text[1])
    assert process_time() - begin < 6  # each took from 9 s to hours

"""What is put together of parts matches as what `re` compiles of their text."""

from __future__ import annotations

import re
from random import Random

import pytest

from orchestra.load.alike import assembled as of_parts
from orchestra.load.alike import xml_items, yaml_items
from orchestra.load.alike.assembled import (
    AS_LONG,
    BEFORE,
    CLOSE,
    EXPRESSION,
    OPEN,
    TEXT,
    assembled,
    expression,
)

_VALUES = (
    yaml_items.MANNER.harmless('"a"', 0, 1, 2),
    yaml_items.MANNER.harmless("{a", 0, 1, 2),
    yaml_items.MANNER.harmless(" a", 0, 1, 2),
    yaml_items.MANNER.harmless(" a:b", 0, 1, 4),
    xml_items.MANNER.harmless(' a="b"', 0, 4, 5),
)
_BEHIND = yaml_items.MANNER.ending("")[1]


def _parts(random: Random) -> tuple[list[of_parts.Part], list[str]]:
    """Return an expression, and what texts that may match it are made of, empty for any value."""
    parts: list[of_parts.Part] = []
    likely: list[str] = []
    opened = 0
    kinds = TEXT, EXPRESSION, OPEN, CLOSE, AS_LONG, BEFORE
    for kind in random.choices(kinds, (4, 4, 1, 1, 1, 1), k=random.randrange(1, 25)):
        if kind in (TEXT, AS_LONG):
            likely.append("".join(random.choices("abn:'\"{}[], \n-$(ü\U0001f600", k=random.randrange(1, 12))))
            parts.append((kind, likely[-1]))
        elif kind == BEFORE:
            likely.append(random.choice("\"'],^-\n"))
            parts += (kind, likely[-1]), (TEXT, likely[-1])
        elif kind == EXPRESSION:
            likely.append("")
            parts += (OPEN, ""), (EXPRESSION, random.choice(_VALUES)), (CLOSE, "")
        elif kind == OPEN or opened:
            opened += 1 if kind == OPEN else -1
            parts.append((kind, ""))
    if random.random() < 0.7:
        parts.append((EXPRESSION, _BEHIND))
        likely.append(random.choice((" # x\n\n", "\n  #y\n", "\n")))
    return [*parts, *[(CLOSE, "")] * opened], likely


@pytest.mark.parametrize("seed", range(20))
def test_as_one_expression(seed: int) -> None:
    random, found = Random(seed), 0  # noqa: S311 - the same every time
    for _ in range(20):
        parts, likely = _parts(random)
        made, usual = assembled(parts), re.compile(expression(parts))
        assert made.groups == usual.groups
        for _ in range(30):
            values = [
                "".join(random.choices("ab1 .:'\"{$(-/\\nul", k=random.randrange(1, 9))) for _ in likely
            ]
            text = "".join(text or value for text, value in zip(likely, values, strict=True))
            text, end = f"xx {text} y", len(text) + 3
            one, other = made.fullmatch(text, 3, end), usual.fullmatch(text, 3, end)
            assert (one and one.regs) == (other and other.regs)
            found += one is not None
    assert found


def test_unknown_interpreters_compile_the_text(monkeypatch: pytest.MonkeyPatch) -> None:
    parts = [(TEXT, "a-b "), (OPEN, ""), (EXPRESSION, "[a-c]+"), (CLOSE, ""), (TEXT, ".")]
    monkeypatch.setattr(of_parts, "_KNOWN", frozenset())
    assert assembled(parts) == re.compile(r"a-b ([a-c]+)\.")

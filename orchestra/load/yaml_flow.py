"""Values between braces that a comma has ended too early: `{if: $(equals $(var a), b)}`."""

from __future__ import annotations

from itertools import takewhile
from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.load.unquoted import in_quotes
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

_TOLD = "a comma ends a value between braces: quotes keep it together"


def joined_pairs(
    pairs: list[tuple[yaml.Node, yaml.Node]], whole: Source, reader: Reader
) -> list[tuple[yaml.Node, yaml.Node]]:
    """Return the pairs of a mapping in braces, with substitutions put together that commas have cut into pieces."""
    kept: list[tuple[yaml.Node, yaml.Node]] = []
    at = 0
    while at < len(pairs):
        key, value = pairs[at]
        empty = takewhile(lambda pair: _is_nothing(pair[1]), pairs[at + 1 :]) if _is_open(value) else ()
        made = _joined(value, [piece for piece, _ in empty], whole, reader)
        kept.append((key, value if made is None else made[0]))
        at += 1 if made is None else 1 + made[1]
    return kept


def _joined(
    first: yaml.Node, rest: list[yaml.Node], whole: Source, reader: Reader
) -> tuple[yaml.Node, int] | None:
    """Return a value with the pieces behind it that close its substitution, and how many; what is wrong is told."""
    begin = first.start_mark.index
    for count, piece in enumerate(rest, 1):
        if not isinstance(piece, yaml.ScalarNode) or piece.style:
            return None
        text = whole.text[begin : piece.end_mark.index]
        if "\n" in text:
            return None
        if text.count("(") == text.count(")"):
            span = whole.span(begin, piece.end_mark.index)
            reader.error(Code.SUBSTITUTION_SYNTAX, _TOLD, span, suggestion=in_quotes(text, span.file))
            made = yaml.ScalarNode(first.tag, text, first.start_mark, piece.end_mark)
            return made, count
    return None


def _is_open(value: yaml.Node) -> bool:
    """Return whether a substitution begins in a value without quotes and does not end there."""
    is_plain = isinstance(value, yaml.ScalarNode) and not value.style
    return is_plain and "$(" in value.value and value.value.count("(") > value.value.count(")")


def _is_nothing(value: yaml.Node) -> bool:
    return isinstance(value, yaml.ScalarNode) and not value.value and not value.style

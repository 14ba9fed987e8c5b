"""Rules among the arguments of a node that rcl cannot read, so that the node ends at once: `-r chatter=talk`.

Source: rcl, `_rcl_parse_remap_rule` and `_rcl_parse_param_rule`: a rule is in two parts with `:=` between them.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.errors import Problems
    from orchestra.resolve.context import Value

OPTIONS: Final = {
    **dict.fromkeys(("-r", "--remap"), "FROM:=TO"),
    **dict.fromkeys(("-p", "--param"), "NAME:=VALUE"),
}
_JOINED: Final = pattern(r"([\w/~.]+)(?:=|:)([^=:\s]+)")


def check_rules(words: Sequence[Value], problems: Problems, *, for_ros: bool) -> None:
    """Report rules without a `:=` where they stand; `for_ros` tells that all words are for rcl."""
    for option, word in _rules(words, for_ros=for_ros):
        if ":=" in word.text:
            continue
        joined = _JOINED.fullmatch(word.text) if _is_written(word) else None
        message = f"'{word.text}' is no rule: behind {option} stands {OPTIONS[option]}"
        instead = f"{joined[1]}:={joined[2]}" if joined is not None else None
        problems.error(Code.BAD_VALUE, message, word.location, suggestion=instead)


def _is_written(word: Value) -> bool:
    """Return whether a word stands at its place as it is."""
    span = word.location.span
    width = span.end_column - span.column
    return word.verbatim or (span.line == span.end_line and width == len(word.text))


def _rules(words: Sequence[Value], *, for_ros: bool) -> Iterator[tuple[str, Value]]:
    """Yield the options with what follows them among the words that rcl reads."""
    reads = for_ros
    for word, following in pairwise(words):
        if word.text in ("--ros-args", "--"):
            reads = word.text == "--ros-args"
        elif reads and word.text in OPTIONS:
            yield word.text, following

"""Scalars at another indentation: their text is taken over, only what stands before it on a line changes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.formatting.lines import indentation, shifted
from orchestra.formatting.refusal import NotFormatted

if TYPE_CHECKING:
    from orchestra.formatting.yaml_nodes import Scalar

STEP = 2

# Tag and anchor on a line of their own.
_ALONE = re.compile(r"^([&!]\S*(?:[ \t]+[&!]\S*)*)[ \t]*\n\s*")
_HEADER = re.compile(r"(?<!\S)[|>][-+1-9]*")


def scalar_lines(scalar: Scalar, text: str, indent: int) -> list[str]:
    """Return the lines of a scalar whose parent is indented so far, -1 for none; the first one without indentation."""
    first, *rest = _ALONE.sub(r"\1 ", text[scalar.start : scalar.end]).split("\n")
    if scalar.style in ("|", ">"):
        return _block(scalar, first.rstrip(), rest, indent)
    if not rest:
        return [first]
    by = max(indent, 0) + STEP - min(indentation(line) for line in rest if line.strip())
    return [_stripped(line) for line in (first, *shifted(rest, by))]


def _block(scalar: Scalar, head: str, rest: list[str], indent: int) -> list[str]:
    """Return a block scalar: its header, and its lines as far behind their least indentation as they were."""
    marks = _HEADER.search(head)
    if marks is None:
        raise NotFormatted("it has a comment between an anchor and its text")
    digit = marks[0].strip("|>+-")
    margin = " " * (indent + int(digit) if digit else max(indent, 0) + STEP)
    old = _margin(scalar.value, rest)
    lines = [margin + line[old:] if len(line) > old else "" for line in rest]
    if "+" in marks[0]:  # line breaks at the end are part of the value
        kept = len(scalar.value) - len(scalar.value.rstrip("\n"))
        lines.extend([""] * (kept - bool(lines)))
    return [head, *lines]


def block_end(text: str, start: int, end: int, value: str) -> int:
    """Return where the last line of a block scalar ends that has anything of its value."""
    alone = _ALONE.match(text[start:end])
    begin = start + (alone.end() if alone else 0)
    first, *lines = text[begin:end].split("\n")
    margin = _margin(value, lines)
    while lines and len(lines[-1]) <= margin:
        lines.pop()
    return begin + len("\n".join([first, *lines]))


def _margin(value: str, lines: list[str]) -> int:
    """Return how far the lines are indented beyond what belongs to the value."""
    line = next((line for line in lines if line.strip()), "")
    own = next((line for line in value.split("\n") if line.strip()), None)
    if own is None:  # nothing but blanks
        return max((len(line) for line in lines), default=0) - max(map(len, value.split("\n")))
    return _blanks(line) - _blanks(own)


def _blanks(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _stripped(line: str) -> str:
    """Return a line of a scalar in quotes without blanks at its end, unless one of these is escaped."""
    stripped = line.rstrip()
    return line if stripped.endswith("\\") else stripped

"""Scalars at another indentation: their text is taken over, only what stands before it on a line changes."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.formatting.lines import indentation, shifted

if TYPE_CHECKING:
    from orchestra.formatting.yaml_tree import Scalar

STEP = 2

_HEADER = re.compile(r"(?<!\S)[|>][-+1-9]*")


def scalar_lines(scalar: Scalar, text: str, indent: int) -> list[str]:
    """Return the lines of a scalar whose parent is indented so far, -1 for none; the first one without indentation."""
    first, *rest = text[scalar.start : scalar.end].split("\n")
    if scalar.style in ("|", ">"):
        return _block(scalar, first.rstrip(), rest, indent)
    if not rest:
        return [first]
    by = max(indent, 0) + STEP - min(indentation(line) for line in rest if line.strip())
    return [_stripped(line) for line in (first, *shifted(rest, by))]


def _block(scalar: Scalar, head: str, rest: list[str], indent: int) -> list[str]:
    """Return a block scalar: its header, and its lines as far behind their least indentation as they were."""
    marks = _HEADER.search(head)
    assert marks is not None  # noqa: S101 - the parser has found one
    digit = marks[0].strip("|>+-")
    margin = " " * (indent + int(digit) if digit else max(indent, 0) + STEP)
    old = _margin(scalar.value, rest)
    lines = [margin + line[old:] if len(line) > old else "" for line in rest]
    if "+" in marks[0]:  # line breaks at the end are part of the value
        kept = len(scalar.value) - len(scalar.value.rstrip("\n"))
        lines.extend([""] * (kept - bool(lines)))
    return [head, *lines]


def _margin(value: str, lines: list[str]) -> int:
    """Return how far the lines are indented beyond what belongs to the value."""
    line = next((line for line in lines if line.strip()), "")
    own = next((line for line in value.split("\n") if line.strip()), "")
    return _blanks(line) - _blanks(own)


def _blanks(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _stripped(line: str) -> str:
    """Return a line of a scalar in quotes without blanks at its end, unless one of these is escaped."""
    stripped = line.rstrip()
    return line if stripped.endswith("\\") else stripped

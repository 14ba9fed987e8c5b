"""The text of a definition with the fields of the types that it uses, one tab deeper each."""

from __future__ import annotations

import re
from enum import Enum
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_BASIC: Final = frozenset(
    {"bool", "byte", "char", "float32", "float64", "string", "wstring"}
    | {f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)}
)
# A type may be bounded (string<=10) and have an array behind it.
_TYPE: Final = re.compile(
    r"(?P<name>[A-Za-z][A-Za-z0-9_]*(?:/[A-Za-z0-9_]+){0,2})(?:<=[0-9]+)?(?:\[[^\]]*\])?"
)
_IDL: Final = "module "
_UNIT: Final = re.compile(r"\s*\[[^,\]]+\]")


class Comments(Enum):
    """Which comments are shown: none, those of the outer type, all."""

    NONE = "none"
    OUTER = "outer"
    ALL = "all"


def expanded(name: str, text_of: Callable[[str], str], comments: Comments = Comments.OUTER) -> str:
    """Return the text of an interface by its full name; `text_of` gives that of any."""
    text = text_of(name)
    if any(line.startswith(_IDL) for line in text.splitlines()):
        return text  # a definition in IDL has no fields to a line
    return "".join(f"{line}\n" for line in _lines(name, text_of, comments, 0))


def _lines(name: str, text_of: Callable[[str], str], comments: Comments, depth: int) -> Iterator[str]:
    shown = comments is Comments.ALL or (comments is Comments.OUTER and depth == 0)
    for whole in text_of(name).splitlines():
        line = whole.rstrip()
        field = without_comment(line)
        text = line if shown else bare(line)
        if text:
            yield "\t" * depth + text
        elif shown:
            yield ""
        if (nested := type_in(field, name.partition("/")[0])) is not None:
            yield from _lines(nested, text_of, comments, depth + 1)


def bare(line: str) -> str:
    """Return a line without its comment, as the ROS 2 tools leave it out.

    They keep comments behind constants, comments that are indented and those without a text, and the `#` of the others.
    """
    field, sign, comment = line.replace("\t", " ").partition("#")
    said = _without_unit(comment.lstrip("#"))
    if not field:
        return line if sign and not said else ""
    if not field.strip() or not said or "=" in field.partition(" ")[2]:
        return line
    return line[: line.find(said.lstrip()) - 1].strip()


def _without_unit(comment: str) -> str:
    """Return a comment without the one unit in brackets that it may have: rosidl takes it for something else."""
    units = _UNIT.findall(comment)
    return comment.replace(units[0], "") if len(units) == 1 else comment


def type_in(field: str, package: str) -> str | None:
    """Return the full name of the type of a field that has fields itself."""
    found = _TYPE.match(field.strip())
    if found is None or found["name"] in _BASIC:
        return None
    match found["name"].split("/"):
        case [local]:
            return f"{package}/msg/{local}"
        case [other, local]:
            return f"{other}/msg/{local}"
    return found["name"]


def without_comment(line: str) -> str:
    """Return a line up to its comment; a `#` in quotes begins none."""
    quote = ""
    for place, character in enumerate(line):
        if quote:
            quote = "" if character == quote and line[place - 1] != "\\" else quote
        elif character in "'\"":
            quote = character
        elif character == "#":
            return line[:place]
    return line

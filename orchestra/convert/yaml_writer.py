"""Launch files in YAML, in block style; short lists of scalars stand in brackets."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.convert.plain import is_plain
from orchestra.convert.tree import Entry, Mapping, Notes, Scalar, Sequence, Style
from orchestra.pyyaml import yaml

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.convert.tree import Document, Item, Node

_WIDEST = 100
_INDENT = "  "
# A text of several lines that a block shows as it is: no blanks at the ends, nothing but printable characters.
_LINE = r"[ -~\u00a0-\ud7ff]*[!-~\u00a1-\ud7ff]"
_BLOCK = re.compile(rf"(?!\s){_LINE}(?:\n+{_LINE})*\n?")


def text_of(document: Document) -> str:
    """Return the text of a launch file."""
    lines = [*_comments(document.header, ""), *([""] if document.header else [])]
    actions = list(_sequence(document.actions, _INDENT * (1 if document.deprecated is None else 2)))
    if document.deprecated is not None:
        lines += ["launch:", f"{_INDENT}deprecated: {_scalar(document.deprecated)}"]
        lines += [f"{_INDENT}children:", *actions] if actions else [f"{_INDENT}children: []"]
    else:
        lines += ["launch:", *actions] if actions else ["launch: []"]
    return "\n".join([*lines, *_comments(document.closing, ""), ""])


def _sequence(sequence: Sequence, indent: str) -> Iterator[str]:
    for item in sequence.items:
        yield from _comments(item.notes.before, indent)
        yield from _item(item, indent)


def _item(item: Item, indent: str) -> Iterator[str]:
    """Yield the lines of an item: the first key of a mapping stands behind the dash."""
    if isinstance(item.node, Mapping):
        entries = item.node.entries
        inner, beside = indent + _INDENT, item.notes.beside
        for index, entry in enumerate(entries):
            notes = entry.notes
            if index == 0:
                yield from _comments(notes.before, indent)
                notes = Notes((), "; ".join(filter(None, (beside, notes.beside))))
            lines = list(_entry(Entry(entry.key, entry.node, notes), inner))
            if index == 0:
                lines[0] = f"{indent}- {lines[0].lstrip()}"
            yield from lines
        return
    yield f"{indent}- {_value(item.node, flow=False)}{_beside(item.notes.beside)}"


def _entry(entry: Entry, indent: str) -> Iterator[str]:
    yield from _comments(entry.notes.before, indent)
    key = f"{indent}{_key(entry.key)}:"
    beside = _beside(entry.notes.beside)
    node = entry.node
    if isinstance(node, Scalar) and (block := _block(node, indent + _INDENT)):
        yield f"{key} {block[0]}{beside}"
        yield from block[1:]
    elif isinstance(node, Scalar):
        yield f"{key} {_scalar(node)}{beside}"
    elif isinstance(node, Mapping):
        yield f"{key}{beside}" if node.entries else f"{key} {{}}{beside}"
        for inner in node.entries:
            yield from _entry(inner, indent + _INDENT)
    elif (flow := _flow(node)) is not None and len(key) + len(flow) < _WIDEST:
        yield f"{key} {flow}{beside}"
    else:
        yield f"{key}{beside}"
        yield from _sequence(node, indent + _INDENT)


def _flow(sequence: Sequence) -> str | None:
    """Return a list in brackets, None where it holds more than scalars."""
    items = [item.node for item in sequence.items]
    if any(item.notes != Notes() or not isinstance(item.node, Scalar) for item in sequence.items):
        return None
    return f"[{', '.join(_value(item, flow=True) for item in items)}]"


def _value(node: Node, *, flow: bool) -> str:
    return (
        _scalar(node, flow=flow)
        if isinstance(node, Scalar)
        else str(_flow(node) if isinstance(node, Sequence) else "{}")
    )


def _scalar(scalar: Scalar, *, flow: bool = False) -> str:
    text = scalar.text
    if scalar.style is not Style.QUOTED and is_plain(text, flow=flow):
        return text
    return _quoted(text)


def _quoted(text: str) -> str:
    if text.isprintable():
        return "'" + text.replace("'", "''") + "'"
    dumped: str = yaml.safe_dump(text, default_style='"', allow_unicode=True, width=float("inf"))
    return dumped.removesuffix("\n")


def _key(key: str) -> str:
    return key if is_plain(key) and re.fullmatch(r"[\w.-]+", key) else _quoted(key)


def _block(scalar: Scalar, indent: str) -> list[str] | None:
    """Return the lines of a block where a text of several lines is best shown as one."""
    text = scalar.text
    if "\n" not in text.rstrip("\n") or scalar.style is Style.PLAIN or not _BLOCK.fullmatch(text):
        return None
    lines = text.removesuffix("\n").split("\n")
    return ["|" if text.endswith("\n") else "|-", *(f"{indent}{line}" if line else "" for line in lines)]


def _comments(comments: Iterable[str], indent: str) -> Iterator[str]:
    for comment in comments:
        yield f"{indent}# {comment}".rstrip() if comment else f"{indent}#"


def _beside(comment: str) -> str:
    return f"  # {comment}" if comment else ""

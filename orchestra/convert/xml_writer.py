"""Launch files in XML: scalars are attributes, all else are elements."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape

from orchestra.convert.plain import is_plain
from orchestra.convert.remarks import UnsayableError
from orchestra.convert.tree import Mapping, Notes, Scalar, Sequence

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.convert.tree import Document, Entry

_WIDEST = 120
_INDENT = "  "
_SEPARATORS = (",", ";", "|", ", ", " and ", "\ue000")
_ESCAPES = {"\n": "&#10;", "\t": "&#9;", "\r": "&#13;"}
_NAME = re.compile(r"[A-Za-z_][\w.-]*")
# What no document may have, not even as a reference (XML 1.0, 2.2).
_FORBIDDEN = re.compile("[^\t\n\r\u0020-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def text_of(document: Document) -> str:
    """Return the text of a launch file. Raises `UnsayableError` for characters that no XML can have."""
    start = "launch"
    if document.deprecated is not None:
        start += f" deprecated={_quoted(document.deprecated)}"
    lines = ['<?xml version="1.0"?>', *_comments(document.header, "")]
    inside = list(_actions(document.actions, _INDENT))
    closing = list(_comments(document.closing, ""))
    lines += [f"<{start}>", *inside, "</launch>"] if inside else [f"<{start}/>"]
    return "\n".join([*lines, *closing, ""])


def _actions(actions: Sequence, indent: str) -> Iterator[str]:
    for item in actions.items:
        yield from _comments(item.notes.before, indent)
        if isinstance(item.node, Mapping) and item.node.entries:
            entry = item.node.entries[0]
            yield from _element(entry.key, entry.node, item.notes, indent)


def _element(name: str, node: object, notes: Notes, indent: str) -> Iterator[str]:
    assert isinstance(node, Mapping)  # noqa: S101 - the caller has asked
    inside: list[str] = []
    attributes: list[str] = []
    kept: list[str] = []
    for entry in node.entries:
        if isinstance(entry.node, Scalar) or _is_list(entry):
            attributes += _attributes(entry, variable=node.variables)
            kept += [*entry.notes.before, *([entry.notes.beside] if entry.notes.beside else [])]
        else:
            inside += _inside(entry, indent + _INDENT)
    yield from _comments(kept, indent)
    start = _start(name, attributes, indent, ">" if inside else "/>")
    start[-1] += _comment(notes.beside)
    if not inside:
        yield from start
        return
    yield from (*start, *inside, f"{indent}</{name}>")


def _start(name: str, attributes: list[str], indent: str, end: str) -> list[str]:
    """Return the start tag, each attribute on a line of its own where they do not fit on one, as `orchestra format`."""
    line = f"{indent}<{' '.join((name, *attributes))}{end}"
    if len(line) <= _WIDEST or not attributes:
        return [line]
    inner = indent + _INDENT * 2
    *others, last = (f"{inner}{attribute}" for attribute in attributes)
    return [f"{indent}<{name}", *others, f"{last}{end}"]


def _inside(entry: Entry, indent: str) -> Iterator[str]:
    """Yield the elements that a key is written as."""
    yield from _comments(entry.notes.before, indent)
    if entry.key == "children":
        assert isinstance(entry.node, Sequence)  # noqa: S101 - the caller has asked
        yield from _actions(entry.node, indent)
    elif isinstance(entry.node, Sequence):
        for item in entry.node.items:
            yield from _comments(item.notes.before, indent)
            yield from _element(entry.key, item.node, item.notes, indent)
    else:
        yield from _element(entry.key, entry.node, Notes((), entry.notes.beside), indent)


def _is_list(entry: Entry) -> bool:
    """Return whether a key is a list that an attribute can hold."""
    if entry.key == "children" or not isinstance(entry.node, Sequence):
        return False
    return not any(isinstance(item.node, Mapping) for item in entry.node.items)


def _attributes(entry: Entry, *, variable: bool) -> Iterator[str]:
    node = entry.node
    if variable and not _NAME.fullmatch(entry.key):
        raise UnsayableError(f"'{entry.key}' cannot be the name of an attribute", _first(node).span)
    if isinstance(node, Scalar):
        yield f"{entry.key}={_quoted(node)}"
        return
    assert isinstance(node, Sequence)  # noqa: S101 - the caller has asked
    yield from _listed(entry.key, node)


def _listed(key: str, sequence: Sequence) -> Iterator[str]:
    """Yield a list as an attribute, and the one that says what separates its items."""
    scalars = [item.node for item in sequence.items if isinstance(item.node, Scalar)]
    if not scalars:
        yield f'{key}="[]"'
        return
    if sequence.free and len(scalars) == 1 and not scalars[0].text.lstrip().startswith("["):
        yield f"{key}={_quoted(scalars[0])}"
        return
    texts = [scalar.text for scalar in scalars]
    if sequence.free and all(is_plain(text, flow=True) for text in texts):
        listed = f"[{', '.join(texts)}]"
        yield f"{key}={_quoted(Scalar(listed, scalars[0].style, scalars[0].span))}"
        return
    separator = next((one for one in _SEPARATORS if not any(one in text for text in texts)), None)
    if separator is None:
        raise UnsayableError("nothing can separate the items of this list", scalars[0].span)
    yield f"{key}={_quoted(Scalar(separator.join(texts), scalars[0].style, scalars[0].span))}"
    yield f'{key}-sep="{separator}"'


def _first(node: object) -> Scalar:
    while isinstance(node, Sequence):
        node = node.items[0].node
    assert isinstance(node, Scalar)  # noqa: S101 - the caller has asked
    return node


def _quoted(scalar: Scalar) -> str:
    """Return an attribute's value in the quotes that it does not have itself."""
    if _FORBIDDEN.search(scalar.text):
        raise UnsayableError("XML cannot have this control character", scalar.span)
    text = escape(scalar.text, _ESCAPES)
    if '"' in text and "'" not in text:
        return f"'{text}'"
    return '"' + text.replace('"', "&quot;") + '"'


def _comments(comments: Iterable[str], indent: str) -> Iterator[str]:
    """Yield comments that follow each other as one."""
    lines = list(comments)
    if len(lines) == 1:
        yield f"{indent}{_comment(lines[0], '')}"
    elif lines:
        yield f"{indent}<!--"
        yield from (f"{indent}{_INDENT}{_sayable(line)}".rstrip() for line in lines)
        yield f"{indent}-->"


def _comment(text: str, before: str = "  ") -> str:
    return f"{before}<!-- {_sayable(text)} -->" if text else ""


def _sayable(text: str) -> str:
    """Return the text of a comment, in which no two dashes can follow each other, and none can be the last."""
    dashed = re.sub("-(?=-)", "- ", _FORBIDDEN.sub("", text))
    return re.sub("-$", "- ", dashed) if dashed.endswith("-") else dashed

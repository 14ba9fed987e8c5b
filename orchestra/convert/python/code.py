"""Expressions of Python as trees, and their layout: that of black and `ruff format`, 88 columns wide.

What does not fit on a line is taken apart at its brackets: arguments of a call go to one line of their own where they
fit there, else, as items of lists and dictionaries, each to a line of its own, with a comma behind the last.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

from orchestra.convert.tree import NONE, Notes
from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

WIDEST = 88
INDENT = "    "


@dataclass(frozen=True, slots=True)
class Atom:
    """What stands on one line, however long it is."""

    text: str


@dataclass(frozen=True, slots=True)
class Element:
    """One item between brackets: `lead` is the keyword or the key in front of it. Without an item: only comments."""

    item: Code | None
    lead: str = ""
    notes: Notes = NONE


@dataclass(frozen=True, slots=True)
class Bracket:
    """Items between brackets: a call where something stands in front of a parenthesis, else a list or a dictionary."""

    start: str
    elements: tuple[Element, ...]
    end: str

    @property
    def is_call(self) -> bool:
        """Whether it is the arguments of a call."""
        return len(self.start) > 1


Code: TypeAlias = Atom | Bracket


def call(name: str, arguments: Iterable[Element]) -> Bracket:
    """Return a call."""
    return Bracket(f"{name}(", tuple(arguments), ")")


def a_list(items: Iterable[Code]) -> Bracket:
    """Return a list."""
    return Bracket("[", tuple(map(Element, items)), "]")


def quoted(text: str) -> str:
    """Return the literal of a text: in double quotes unless that takes more backslashes."""
    literal = repr(text)
    inner = literal[1:-1] if literal[0] == '"' else literal[1:-1].replace("\\'", "'")
    quote = "'" if text.count('"') > text.count("'") else '"'
    return f"{quote}{inner.replace(quote, chr(92) + quote)}{quote}"


def string(text: str) -> Atom:
    """Return a text."""
    return Atom(quoted(text))


def lines(code: Code, indent: str, lead: str = "", trail: str = "", beside: str = "") -> Iterator[str]:
    """Yield the lines of an expression between what stands in front of it and behind; `beside` is a comment."""
    flat = flat_text(code)
    comment = f"  # {beside}" if beside else ""
    if flat is not None and (len(indent + lead + flat + trail + comment) <= WIDEST or isinstance(code, Atom)):
        yield f"{indent}{lead}{flat}{trail}{comment}"
        return
    if isinstance(code, Atom):
        yield f"{indent}{lead}{code.text}{trail}{comment}"
        return
    yield f"{indent}{lead}{code.start}{comment}"
    inner = indent + INDENT
    whole = _on_one_line(code)
    if whole is not None and len(inner + whole) <= WIDEST:
        yield f"{inner}{whole}"
    else:
        for element in code.elements:
            yield from _element(element, inner)
    yield f"{indent}{code.end}{trail}"


def flat_text(code: Code) -> str | None:
    """Return an expression on one line, None where comments stand in it."""
    if isinstance(code, Atom):
        return code.text
    inner = _flat_items(code)
    if inner is None:
        return None
    comma = "," if code.start == "(" and len(code.elements) == 1 else ""
    return f"{code.start}{inner}{comma}{code.end}"


def _flat_items(code: Bracket) -> str | None:
    items = []
    for element in code.elements:
        flat = None if element.item is None or element.notes != NONE else flat_text(element.item)
        if flat is None:
            return None
        items.append(element.lead + flat)
    return ", ".join(items)


def _on_one_line(code: Bracket) -> str | None:
    """Return the arguments of a call for a line of their own; what is no call is taken apart into its items."""
    return _flat_items(code) if code.is_call else None


def _element(element: Element, indent: str) -> Iterator[str]:
    notes = element.notes
    before, beside = notes.before, notes.beside
    if element.item is None:
        yield from comments((*before, *([beside] if beside else ())), indent)
        return
    written = list(lines(element.item, indent, element.lead, ",", beside))
    if beside and len(written[0]) > WIDEST:
        before, written = (*before, beside), list(lines(element.item, indent, element.lead, ","))
    yield from comments(before, indent)
    yield from written


def comments(texts: Iterable[str], indent: str) -> Iterator[str]:
    """Yield comments, each on a line."""
    for text in texts:
        yield f"{indent}# {text}" if text else f"{indent}#"

"""The JSON text of records, written in one pass.

`json.dumps` needs plain data first, and writes it without its C code where lines are indented: a plan of a thousand
nodes took five seconds. The text is the one that it gives with `ensure_ascii=False`.
"""

from __future__ import annotations

from enum import Enum
from json.encoder import encode_basestring as quoted
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from orchestra.errors import Problem
from orchestra.fields import fields, is_dataclass
from orchestra.location import Location, Span, all_of

if TYPE_CHECKING:
    from collections.abc import Callable

    Write = Callable[[Any, str], str]

_NO_NUMBERS = {"nan": "NaN", "inf": "Infinity", "-inf": "-Infinity"}
MARK = "\0"  # which JSON has no other use for: in texts it is escaped
_PLACE = ("file", "line", "column", "end_line", "end_column")


def text_of(value: Any, indent: int | None = None, apart: type | None = None) -> str:  # noqa: ANN401 - records of the plan
    """Return the JSON text of a value made of the plan's records, in one line where there is no `indent`.

    Values of the type `apart` stand between two `MARK`, without which it is that text.
    """
    return _Writing(" " * indent if indent is not None else "", apart).text(
        value, "\n" if indent is not None else ""
    )


class _Writers(dict[type, "Write"]):
    """How values of each type are written, which is found out for the first one."""

    def __init__(self, find: Callable[[type], Write]) -> None:
        self._find = find

    def __missing__(self, kind: type) -> Write:
        write = self[kind] = self._find(kind)
        return write


class _Writing:
    """Writes values of all types; `line` is the break and the indentation before what ends them, if any."""

    def __init__(self, step: str, apart: type | None = None) -> None:
        self._step = step
        self._apart = apart
        self._chains: dict[tuple[int, str], str] = {}
        self._write: dict[type, Write] = _Writers(self._found)
        self._write |= {
            str: lambda value, _: quoted(value),
            bool: lambda value, _: "true" if value else "false",
            type(None): lambda _value, _: "null",
            int: lambda value, _: int.__repr__(value),
            float: lambda value, _: number(value),
            dict: self._mapping,
            tuple: self._list,
            list: self._list,
            Location: self._location,
            Problem: self._problem,
        }

    def text(self, value: Any, line: str) -> str:  # noqa: ANN401 - records of the plan
        """Return the text of a value."""
        return self._write[type(value)](value, line)

    def _found(self, kind: type) -> Write:
        """Choose how values of a type are written, which is then known."""
        if issubclass(kind, Enum):
            write: Write = lambda value, line: self.text(value.value, line)  # noqa: E731 - one of several
        elif issubclass(kind, Location):
            write = self._location
        elif is_dataclass(kind):
            write = self._record(kind)
            if kind is self._apart:
                whole = write
                write = lambda value, line: f"{MARK}{whole(value, line)}{MARK}"  # noqa: E731 - as above
        else:
            known = (dict, tuple, list, str, int, float)
            nearest = next((base for base in known if issubclass(kind, base)), None)
            if nearest is None:
                raise TypeError(f"Object of type {kind.__name__} is not JSON serializable")
            write = self._write[nearest]
        return write

    def _record(self, kind: Any) -> Write:  # noqa: ANN401 - a dataclass
        names = [field.name for field in fields(kind)]
        heads = [f'"{name}": ' for name in names]
        empty = [f"{head}null" for head in heads]
        values: Callable[[Any], Any] = attrgetter(*names) if len(names) > 1 else _alone(names)
        known = self._write

        def write(value: Any, line: str) -> str:  # noqa: ANN401 - of this kind
            inner = line and line + self._step
            entries = [
                none if item is None else head + known[type(item)](item, inner)
                for none, head, item in zip(empty, heads, values(value), strict=True)
            ]
            return "{" + inner + ("," + (inner or " ")).join(entries) + line + "}"

        return write

    def _mapping(self, value: dict[str, Any], line: str) -> str:
        if not value:
            return "{}"
        inner = line and line + self._step
        known = self._write
        entries = [f"{quoted(name)}: {known[type(item)](item, inner)}" for name, item in value.items()]
        return "{" + inner + ("," + (inner or " ")).join(entries) + line + "}"

    def _list(self, value: tuple[Any, ...] | list[Any], line: str) -> str:
        if not value:
            return "[]"
        inner = line and line + self._step
        known = self._write
        items = [known[type(item)](item, inner) for item in value]
        return "[" + inner + ("," + (inner or " ")).join(items) + line + "]"

    def _location(self, value: Location, line: str) -> str:
        inner = line and line + self._step
        return f"{{{inner}{self._place(value.span, inner)}{self._chain(value.included_from, inner)}{line}}}"

    def _problem(self, value: Problem, line: str) -> str:
        inner = line and line + self._step
        between = "," + (inner or " ")
        facts = (("code", value.code.value), ("severity", value.severity.value), ("message", value.message))
        told = "".join(f'"{name}": {quoted(text)}{between}' for name, text in facts)
        unknown = "".join(f'"{name}": null{between}' for name in _PLACE)
        place = unknown if value.span is None else self._place(value.span, inner)
        suggestion = f'"suggestion": {self.text(value.suggestion, inner)}{between}'
        notes = f'"notes": {self._list(value.notes, inner)}{between}'
        chain = self._chain(value.included_from, inner)
        return "{" + inner + told + place + suggestion + notes + chain + line + "}"

    def _place(self, span: Span, inner: str) -> str:
        """Return the fields of a span, with what stands before the next one."""
        between = "," + (inner or " ")
        file, line, column, end_line, end_column = all_of(span)
        return (
            f'"file": {quoted(file)}{between}"line": {line}{between}"column": {column}{between}'
            f'"end_line": {end_line}{between}"end_column": {end_column}{between}'
        )

    def _chain(self, chain: tuple[Span, ...], inner: str) -> str:
        """Return the field with the includes on the way, which are the same for all that stands in a file."""
        if not chain:
            return '"included_from": []'
        key = (id(chain), inner)
        if key not in self._chains:
            starts = [{"file": span.file, "line": span.line, "column": span.column} for span in chain]
            self._chains[key] = f'"included_from": {self._list(starts, inner)}'
        return self._chains[key]


def _alone(names: list[str]) -> Callable[[Any], Any]:
    return lambda value: tuple(getattr(value, name) for name in names)


def number(value: float) -> str:
    """Return the JSON text of a number with a point."""
    text = float.__repr__(value)
    return _NO_NUMBERS.get(text, text)

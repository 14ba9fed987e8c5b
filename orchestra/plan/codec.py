"""Plans as JSON and back, with the standard library alone."""

from __future__ import annotations

import json
import sys
import types
import typing
from collections.abc import Callable
from enum import Enum
from functools import cache, lru_cache
from typing import Any, TypeAlias

from orchestra.errors import Problem
from orchestra.fields import fields, is_dataclass
from orchestra.location import Location, Span, point
from orchestra.patterns import pattern
from orchestra.plan import model
from orchestra.plan.json_text import text_of

_SCALARS = frozenset({str, int, float, bool, type(None)})
_SCALAR_WORDS = frozenset({"str", "int", "float", "bool", "None"})
Read: TypeAlias = Callable[[Any], Any]

_SURROGATE = pattern("[\ud800-\udfff]")


def dumps(plan: model.Plan | dict[str, Any], *, indent: int | None = None, apart: type | None = None) -> str:
    """Return the plan, or what JSON data says of one, as JSON: the same plan always gives the same text.

    Texts that are no Unicode, as bytes of the command line may be, are written as escapes, so that it is always UTF-8.
    Records of a type may stand `apart` (`text_of`).
    """
    text = text_of(plan, indent, apart)
    return text if text.isascii() else _SURROGATE.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


def loads(text: str | bytes) -> model.Plan:
    """Read a plan that `dumps` wrote. Raises `ValueError` where it is not one of this version."""
    return plan_from(json.loads(text))


def plan_from(document: Any) -> model.Plan:  # noqa: ANN401 - JSON
    """Return the plan that JSON data stands for. Raises `ValueError` where it is not one of this version."""
    if not isinstance(document, dict) or document.get("version") != model.VERSION:
        raise ValueError(f"not a plan of version {model.VERSION}")
    try:
        plan: model.Plan = decode(model.Plan, document)
    except (KeyError, TypeError, AttributeError, IndexError) as error:
        raise ValueError(f"not a whole plan: {type(error).__name__}: {error}") from error
    return plan


def encode(value: Any) -> Any:  # noqa: ANN401 - JSON
    """Return JSON data for a value made of the plan's dataclasses."""
    if type(value) in _SCALARS:
        return value
    if isinstance(value, Location):
        return {**_plain_span(value.span), "included_from": [_start(span) for span in value.included_from]}
    if isinstance(value, Problem):
        return encode_problem(value)
    if isinstance(value, Enum):
        return value.value
    if is_dataclass(value) and not isinstance(value, type):
        return {name: encode(getattr(value, name)) for name in _names(type(value))}
    if isinstance(value, dict):
        return {key: encode(item) for key, item in value.items()}
    if isinstance(value, tuple | list):
        return [encode(item) for item in value]
    return value


@cache
def _names(kind: Any) -> tuple[str, ...]:  # noqa: ANN401 - a dataclass
    return tuple(entry.name for entry in fields(kind))


def encode_problem(problem: Problem) -> dict[str, Any]:
    """Return the flat JSON form of a problem; the places are null where it has none."""
    span = problem.span
    place = _plain_span(span) if span else dict.fromkeys(("file", "line", "column", "end_line", "end_column"))
    return {
        "code": problem.code.value,
        "severity": problem.severity.value,
        "message": problem.message,
        **place,
        "suggestion": problem.suggestion,
        "notes": list(problem.notes),
        "included_from": [_start(at) for at in problem.included_from],
    }


def decode(kind: Any, data: Any) -> Any:  # noqa: ANN401 - JSON
    """Build a value of a type of the plan from JSON data."""
    return _reader(kind)(data)


@cache
def _reader(kind: Any) -> Read:  # noqa: ANN401 - a type of any form
    """Return what builds values of a type."""
    if kind is Location:
        return _location
    if kind is Problem:
        return _problem
    origin = typing.get_origin(kind)
    if origin in (types.UnionType, typing.Union):
        return _union_reader(kind)
    if origin is tuple:
        item = _reader(typing.get_args(kind)[0])
        return tuple if item is _as_it_is else lambda data: tuple(map(item, data))
    if origin is dict:
        entry = _reader(typing.get_args(kind)[1])
        return lambda data: {key: entry(value) for key, value in data.items()}
    return _record_reader(kind) if _is_record(kind) else _as_it_is


def _record_reader(kind: Any) -> Read:  # noqa: ANN401 - a dataclass
    readers: dict[str, Read] = {}
    for entry in fields(kind):
        readers[entry.name] = _later(kind, entry.name, str(entry.type), readers)

    def read(data: Any) -> Any:  # noqa: ANN401 - JSON
        # What an older version has not written keeps its default.
        values = {name: reader(data[name]) for name, reader in readers.items() if name in data}
        return kind(**values)

    return read


def _later(kind: Any, name: str, hint: str, readers: dict[str, Read]) -> Read:  # noqa: ANN401 - a dataclass
    """Return what reads a field; its hint is evaluated, in a twentieth of a millisecond, for the first value that asks.

    Few fields of a plan have one: what is null, empty or a scalar can be told by the text of the hint.
    """
    if _SCALAR_WORDS.issuperset(hint.split(" | ")):
        return _as_it_is
    nullable, sequence, mapping = hint.endswith("| None"), hint.startswith("tuple["), hint.startswith("dict[")

    def read(data: Any) -> Any:  # noqa: ANN401 - JSON
        if data is None and nullable:
            return None
        if sequence and data == []:
            return ()
        if mapping and data == {}:
            return {}
        reader = readers[name] = _reader(_hint(kind, name))
        return reader(data)

    return read


def _as_it_is(data: Any) -> Any:  # noqa: ANN401 - JSON
    return data


def _is_record(kind: Any) -> bool:  # noqa: ANN401 - a type of any form
    return is_dataclass(kind)


@cache
def _hint(kind: type, name: str) -> Any:  # noqa: ANN401 - a type of any form
    """Return the type of one field."""
    base = next(base for base in kind.__mro__ if name in vars(base).get("__annotations__", ()))
    alone = types.SimpleNamespace(__annotations__={name: base.__annotations__[name]})
    return typing.get_type_hints(alone, vars(sys.modules[base.__module__]))[name]


def _union_reader(kind: Any) -> Read:  # noqa: ANN401 - a union
    """Choose the alternative: actions by their `action`, lists become tuples, scalars stay."""
    alternatives = [item for item in typing.get_args(kind) if item is not type(None)]
    records = [item for item in alternatives if _is_record(item)]
    mappings = [item for item in alternatives if typing.get_origin(item) is dict]
    lists = [item for item in alternatives if typing.get_origin(item) is tuple]

    def read(data: Any) -> Any:  # noqa: ANN401 - JSON
        if isinstance(data, dict):
            found = records
            if len(records) > 1:
                found = [
                    item for item in records if typing.get_args(_hint(item, "action"))[0] == data["action"]
                ]
            return decode((found or mappings)[0], data)
        if isinstance(data, list):
            return decode(lists[0], data) if len(lists) == 1 else tuple(data)
        return data

    return read


def _plain_span(span: Span) -> dict[str, Any]:
    return {
        "file": span.file,
        "line": span.line,
        "column": span.column,
        "end_line": span.end_line,
        "end_column": span.end_column,
    }


def _start(span: Span) -> dict[str, Any]:
    return {"file": span.file, "line": span.line, "column": span.column}


def _location(data: dict[str, Any]) -> Location:
    chain = data["included_from"]
    found = _starts(*[(at["file"], at["line"], at["column"]) for at in chain]) if chain else ()
    return Location(_span(data), found)


@lru_cache(maxsize=1024)  # all that stands in a file has the same one
def _starts(*chain: tuple[str, int, int]) -> tuple[Span, ...]:
    return tuple(point(*at) for at in chain)


def _span(data: dict[str, Any]) -> Span:
    line, column = data["line"], data["column"]
    file = sys.intern(data["file"])
    return Span(file, line, column, data.get("end_line", line), data.get("end_column", column))


def _problem(data: dict[str, Any]) -> Problem:
    return Problem(
        code=_hint(Problem, "code")(data["code"]),
        severity=_hint(Problem, "severity")(data["severity"]),
        message=data["message"],
        span=_span(data) if data["file"] is not None else None,
        included_from=tuple(_span(at) for at in data["included_from"]),
        suggestion=data["suggestion"],
        notes=tuple(data["notes"]),
    )

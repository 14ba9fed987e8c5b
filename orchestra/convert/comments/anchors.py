"""What comments can stand with: entities and their fields, with the lines at which they begin."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.place import span_in
from orchestra.convert.below import entities_below
from orchestra.convert.kinds import key_of
from orchestra.dataclass import dataclass
from orchestra.description.entity import Entity
from orchestra.description.text import Constant, Template

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from orchestra.location import Span

# Keywords of Python that are not spelled like the fields that they give.
_KEYWORDS: Final = {
    "actions": "children",
    "additional_env": "env",
    "arguments": "args",
    "composable_node_descriptions": "composable_node",
    "default_value": "default",
    "dst": "to",
    "env": "env_only",
    "executable": "exec",
    "extra_arguments": "extra_arg",
    "launch_arguments": "arg",
    "launch_configurations": "keep",
    "msg": "message",
    "package": "pkg",
    "parameters": "param",
    "prefix": "launch_prefix",
    "remappings": "remap",
    "ros_arguments": "ros_args",
    "src": "from_",
    "target_container": "target",
}


@dataclass(frozen=True, slots=True)
class Anchor:
    """A place, and the entity that begins there, or the name of the field whose value does."""

    line: int
    column: int
    entity: Entity
    name: str = ""


def anchors(entities: Iterable[Entity], file: str) -> Iterator[Anchor]:
    """Yield what stands in a file in YAML or XML, entities before what is in them."""
    for entity in entities:
        if entity.span.file == file:
            yield Anchor(entity.span.line, entity.span.column, entity)
        for name in type(entity).model_fields:
            value = getattr(entity, name)
            for item in value if isinstance(value, tuple) else (value,):
                if isinstance(item, Entity):
                    yield from anchors((item,), file)
                elif isinstance(item, Template | Constant) and item.span.file == file:
                    yield Anchor(item.span.line, item.span.column, entity, name)


def anchors_in_code(entities: Iterable[Entity], file: str, text: str) -> Iterator[Anchor]:
    """Yield what stands in a file in Python: calls, their keywords, and the entries of dictionaries in these."""
    calls = {_span(file, node): node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call)}
    seen: set[Span] = set()
    for entity in entities_below(entities):
        call = calls.get(entity.span)
        if call is None or entity.span in seen:
            continue
        seen.add(entity.span)
        yield Anchor(entity.span.line, entity.span.column, entity)
        for keyword in call.keywords:
            if keyword.arg is not None:
                yield from _of_keyword(entity, keyword.arg, keyword)


def _of_keyword(entity: Entity, word: str, keyword: ast.keyword) -> Iterator[Anchor]:
    model = type(entity)
    name = _KEYWORDS.get(word, word)
    if word == "condition":
        name = "if_" if getattr(entity, "if_", None) is not None else "unless"
    if name not in model.model_fields:
        by_key = {key_of(model, field): field for field in model.model_fields}
        name = by_key.get(name, "")
    yield Anchor(keyword.lineno, keyword.col_offset + 1, entity, name)
    value = getattr(entity, name) if name else None
    if isinstance(value, tuple):
        parts = {_name(part): part for part in reversed(value) if isinstance(part, Entity)}
        yield from _of_entries(keyword.value, parts)


def _of_entries(value: ast.expr, parts: Mapping[str | None, Entity]) -> Iterator[Anchor]:
    """Yield the entries of dictionaries, and the pairs, that have become parts of an entity."""
    for node in ast.walk(value):
        keys: list[Any] = []
        if isinstance(node, ast.Dict):
            keys = node.keys
        elif isinstance(node, ast.Tuple):
            keys = node.elts[:1]
        for key in keys:
            if isinstance(key, ast.Constant) and isinstance(key.value, str) and key.value in parts:
                yield Anchor(key.lineno, key.col_offset + 1, parts[key.value])


def _name(part: Entity) -> str | None:
    template = getattr(part, "name", None) or getattr(part, "from_", None)
    return template.constant if isinstance(template, Template) else None


def _span(file: str, node: ast.expr) -> Span:
    return span_in(file, (node.lineno, node.end_lineno, node.col_offset, node.end_col_offset))

"""Paths that are relative to the launch file, for a result that stands in another folder."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.convert.mapped import mapped, with_parts
from orchestra.description.actions.include import Include
from orchestra.description.actions.node import Node
from orchestra.description.actions.set_parameters_from_file import SetParametersFromFile
from orchestra.description.entity import Entity
from orchestra.description.parts import Param
from orchestra.description.text import Call, Constant, Template, Words
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from orchestra.description.entity import Action

_PATHS: Final = (
    (Include, "file"),
    (Node, "params_schema"),
    (Node, "script"),
    (Param, "from_"),
    (SetParametersFromFile, "filename"),
)


def moved(actions: tuple[Action, ...], folder: str, output: str) -> tuple[Action, ...]:
    """Return the actions of a file in a folder as they are written in another one."""
    way = os.path.relpath(folder, output)
    if way == os.curdir:
        return actions
    return tuple(_moved(mapped(action, lambda value: _text(value, way)), folder, way) for action in actions)


def _moved(value: Any, folder: str, way: str) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    """Return an entity, or several, with their paths from elsewhere: those of files that are beside the launch file."""
    if isinstance(value, tuple):
        return tuple(_moved(item, folder, way) for item in value)
    if not isinstance(value, Entity):
        return value
    updates = {}
    for name in type(value).model_fields:
        given = getattr(value, name)
        if isinstance(given, Template) and any(
            isinstance(value, kind) and name == key for kind, key in _PATHS
        ):
            updates[name] = _path(given, folder, way)
        elif isinstance(given, Entity | tuple):
            updates[name] = _moved(given, folder, way)
    return value.model_copy(update=updates)


def _path(template: Template, folder: str, way: str) -> Template:
    text = template.constant
    if text is None or not text or Path(text).is_absolute() or not Path(folder, text).exists():
        return template
    path = os.path.normpath(Path(way, text))
    return Template((Words(path, template.span),), escaped(path), template.span)


def _text(value: Template | Constant, way: str) -> Template | Constant:
    """Return a text in which the folder of the launch file is the one from which it was written."""
    if not isinstance(value, Template):
        return value
    return with_parts(value, lambda part: _part(part, way))


def _part(part: Any, way: str) -> tuple[Any, ...]:  # noqa: ANN401 - a part of a description, whatever it is
    if isinstance(part, Call) and part.name == "dirname":
        return (part, Words(f"/{way}", part.span))
    return (part,)

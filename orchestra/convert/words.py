"""The words of the launch language for models, and the order in which keys are written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.description.actions import ACTIONS
from orchestra.description.entity import Entity
from orchestra.description.text import Constant, Template
from orchestra.location import is_python

if TYPE_CHECKING:
    from orchestra.description.entity import Action

_NAMES: Final = {place: name for name, place in ACTIONS.items()}
# What says what an action is comes first, what only qualifies it last.
_FIRST: Final = (
    *(
        "if_",
        "unless",
        "pkg",
        "plugin",
        "exec",
        "module",
        "script",
        "cmd",
        "file",
        "target",
        "period",
        "for_each",
    ),
    *("name", "from_", "to", "value", "type", "allow_substs", "default", "choices", "choice", "description"),
    *("namespace", "exec_name", "args", "ros_args", "param", "remap", "arg", "let"),
)
_LAST: Final = ("composable_node", "children")


def name_of(action: Action) -> str | None:
    """Return the word for an action in launch files, None where only Python has one."""
    model = type(action)
    return _NAMES.get(f"{model.__module__.rpartition('.')[2]}:{model.__name__}")


def ordered(entity: Entity) -> list[str]:
    """Return the fields of an entity: as its author has them, where that is known, actions inside it last."""
    model = type(entity)
    fields = list(model.model_fields)
    order = {field: index for index, field in enumerate((*_FIRST, *(f for f in fields if f not in _FIRST)))}
    order |= {field: len(order) + index for index, field in enumerate(_LAST)}
    places = {field: _place(getattr(entity, field)) for field in fields}
    known = not is_python(entity.span)
    return sorted(
        fields,
        key=lambda field: (field in _LAST, (places[field] or (0, 0)) if known else (0, 0), order[field]),
    )


def _place(value: Any) -> tuple[int, int] | None:  # noqa: ANN401 - a part of a description, whatever it is
    """Return line and column where a value begins."""
    if isinstance(value, Template | Constant | Entity):
        return value.span.line, value.span.column
    items = value.values() if isinstance(value, dict) else value if isinstance(value, tuple) else ()
    return min((place for place in map(_place, items) if place is not None), default=None)

"""How a key is written in XML: as an attribute or as an element, told by the type of the model's field."""

from __future__ import annotations

import types
from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum, auto
from functools import cache
from typing import Annotated, Any, Union, get_args, get_origin

from orchestra.description.entity import Action, Entity
from orchestra.description.text import Template


class Kind(Enum):
    """What stands behind a key."""

    TEXT = auto()  # an attribute
    LIST = auto()  # an attribute that is a list of scalars
    PART = auto()  # one element
    PARTS = auto()  # any number of elements
    VARIABLES = auto()  # one element whose attributes are names of the user's choice
    ACTIONS = auto()  # all elements that are not keys


_ELEMENTS = (Kind.PART, Kind.PARTS, Kind.VARIABLES)


@dataclass(frozen=True, slots=True)
class Form:
    """A kind, and the model of the parts where they have one."""

    kind: Kind
    model: type[Entity] | None = None


@dataclass(frozen=True, slots=True)
class Forms:
    """The form of every key of a model; those that are elements; whether other elements in it are actions."""

    by_key: Mapping[str, Form]
    elements: frozenset[str]
    holds_actions: bool


@cache
def forms_of(model: type[Entity] | None) -> Forms:
    """Return the forms of a model's keys, none where no model is known."""
    fields = model.model_fields if model is not None else {}
    forms = {entry.alias or name: _form(entry.annotation) for name, entry in fields.items()}
    elements = frozenset(key for key, form in forms.items() if form.kind in _ELEMENTS)
    return Forms(forms, elements, any(form.kind is Kind.ACTIONS for form in forms.values()))


def _form(annotation: Any) -> Form:  # noqa: ANN401 - a type
    alternatives = [_bare(item) for item in _alternatives(_bare(annotation)) if item is not type(None)]
    if Template in alternatives:
        return Form(Kind.TEXT)
    for item in alternatives:
        if get_origin(item) is dict:
            return Form(Kind.VARIABLES)
        if isinstance(item, type) and issubclass(item, Entity):
            return Form(Kind.PART, item)
        if get_origin(item) is tuple:
            return _form_of_items(_bare(get_args(item)[0]))
    return Form(Kind.TEXT)


def _form_of_items(item: Any) -> Form:  # noqa: ANN401 - a type
    if isinstance(item, type) and issubclass(item, Action):
        return Form(Kind.ACTIONS)
    if isinstance(item, type) and issubclass(item, Entity):
        return Form(Kind.PARTS, item)
    return Form(Kind.LIST)


def _bare(annotation: Any) -> Any:  # noqa: ANN401 - a type
    """Return a type without what is annotated to it."""
    while get_origin(annotation) is Annotated:
        annotation = get_args(annotation)[0]
    return annotation


def _alternatives(annotation: Any) -> tuple[Any, ...]:  # noqa: ANN401 - a type
    return get_args(annotation) if get_origin(annotation) in (Union, types.UnionType) else (annotation,)

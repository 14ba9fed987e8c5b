"""How a key is written in XML: as an attribute or as an element, told by the type of the model's field."""

from __future__ import annotations

import types
from collections.abc import Iterator, Mapping
from enum import Enum, auto
from functools import cache
from typing import Annotated, Any, Union, get_args, get_origin

from orchestra.dataclass import dataclass
from orchestra.description.entity import Action, Entity
from orchestra.description.short import Short
from orchestra.description.text import Template


class Kind(Enum):
    """What stands behind a key."""

    TEXT = auto()  # an attribute
    VALUE = auto()  # an attribute that is a list where it is written as one
    LIST = auto()  # an attribute that is a list of scalars
    PART = auto()  # one element
    PARTS = auto()  # any number of elements
    VARIABLES = auto()  # one element whose attributes are names of the user's choice
    ACTIONS = auto()  # all elements that are not keys


_ELEMENTS = (Kind.PART, Kind.PARTS, Kind.VARIABLES)


@dataclass(frozen=True, slots=True)
class Form:
    """A kind, the model of the parts where they have one, and whether a key may take the other form too.

    An attribute may also be an element with names of the user's choice, an element with a short form an attribute.
    """

    kind: Kind
    model: type[Entity] | None = None
    or_variables: bool = False
    or_text: bool = False


@dataclass(frozen=True, slots=True)
class Forms:
    """The form of every key of a model; those that are elements; whether other elements in it are actions.

    `others` is the form of attributes that are no key, `texts` are the keys that are plain attributes.
    """

    by_key: Mapping[str, Form]
    elements: frozenset[str]
    holds_actions: bool = False
    others: Form = Form(Kind.TEXT)
    texts: frozenset[str] = frozenset()


VARIABLES = Forms({}, frozenset(), others=Form(Kind.VALUE))


@cache
def forms_of(model: type[Entity] | None) -> Forms:
    """Return the forms of a model's keys, none where no model is known.

    Raises `TypeError` for a field of a type that nobody has thought of.
    """
    fields = model.model_fields if model is not None else {}
    forms = {entry.alias or name: _form(entry.annotation) for name, entry in fields.items()}
    elements = frozenset(key for key, form in forms.items() if form.kind in _ELEMENTS)
    actions = any(form.kind is Kind.ACTIONS for form in forms.values())
    texts = frozenset(key for key, form in forms.items() if form.kind is Kind.TEXT)
    return Forms(forms, elements, actions, texts=texts)


def _form(annotation: Any) -> Form:  # noqa: ANN401 - a type
    alternatives = tuple(_alternatives(annotation))
    variables = any(get_origin(item) is dict for item in alternatives)
    if Template in alternatives:
        return Form(Kind.TEXT, or_variables=variables)
    if variables:
        return Form(Kind.VARIABLES)
    for item in alternatives:
        if isinstance(item, type) and issubclass(item, Entity):
            return Form(Kind.PART, item, or_text=_is_short(annotation))
        if get_origin(item) is tuple:
            return _form_of_items(next(_alternatives(get_args(item)[0])))
    raise TypeError(f"a field of type {annotation} has no form in XML")


def _form_of_items(item: Any) -> Form:  # noqa: ANN401 - a type
    if isinstance(item, type) and issubclass(item, Action):
        return Form(Kind.ACTIONS)
    if isinstance(item, type) and issubclass(item, Entity):
        return Form(Kind.PARTS, item)
    return Form(Kind.LIST)


def _is_short(annotation: Any) -> bool:  # noqa: ANN401 - a type
    """Return whether one of the types that a value may have has a short form."""
    if get_origin(annotation) is Annotated:
        return any(isinstance(item, Short) for item in get_args(annotation)[1:])
    return any(map(_is_short, get_args(annotation)))


def _alternatives(annotation: Any) -> Iterator[Any]:  # noqa: ANN401 - a type
    """Yield the types that a value may have, without what is annotated to them."""
    while get_origin(annotation) is Annotated:
        annotation = get_args(annotation)[0]
    if get_origin(annotation) in (Union, types.UnionType):
        for item in get_args(annotation):
            yield from _alternatives(item)
    elif annotation is not type(None):
        yield annotation

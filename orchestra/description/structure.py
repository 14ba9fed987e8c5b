"""Schemas for pydantic's core, made of the annotations of fields.

pydantic makes the same of the same annotations, and a test holds the two to each other. It takes a fifth of a second of
the processor to be imported and to look at all that a type may be; the models use a few kinds of types.
"""

from __future__ import annotations

from functools import partial
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Annotated, Any, Literal, Protocol, TypeAlias, Union, get_args, get_origin

from orchestra.dataclass import dataclass
from orchestra.fields import field

if TYPE_CHECKING:
    from collections.abc import Callable

Schema: TypeAlias = dict[str, Any]

_NAMES = {str: "str", bool: "bool"}


class Structured(Protocol):
    """A model: a class that says how it is read."""

    @classmethod
    def structure(cls, schemas: Schemas) -> Schema:
        """Return the schema of an object of the class."""


def structure_of(model: type[Structured]) -> Schema:
    """Return the schema of a model and of all in it. Raises `KeyError` for a type that nobody has thought of."""
    schemas = Schemas()
    whole = schemas.of(model)
    named = list(schemas.named.values())
    return {"type": "definitions", "schema": whole, "definitions": named} if named else whole


@dataclass(slots=True)
class Schemas:
    """The schemas of one validator; those of models that stand in themselves have names."""

    named: dict[str, Schema] = field(default_factory=dict)
    _open: set[Any] = field(default_factory=set)
    _made: dict[int, Schema] = field(
        default_factory=dict
    )  # by identity: annotations live as long as their classes

    def of(self, annotation: Any) -> Schema:  # noqa: ANN401 - a type
        """Return the schema of a type. Raises `KeyError` for one that nobody has thought of."""
        origin = get_origin(annotation)
        if origin is not None:
            return self._of_origin(origin, annotation)
        if annotation is Any:
            return {"type": "any"}
        if hasattr(annotation, "structure"):
            return self._of_model(annotation)
        return {"type": _NAMES[annotation]}

    def _of_origin(self, origin: Any, annotation: Any) -> Schema:  # noqa: ANN401 - types
        """Return the schema of a type that is made of others: most fields are of the same few."""
        known = self._made.get(id(annotation))
        if known is None:
            known = _WAYS[origin](self, annotation)
            self._made[id(annotation)] = known
        return known

    def _of_model(self, model: Any) -> Schema:  # noqa: ANN401 - a model
        name = f"{model.__module__}.{model.__qualname__}"
        reference = {"type": "definition-ref", "schema_ref": name}
        if model in self._open or name in self.named:
            self.named.setdefault(name, {})
            return reference
        self._open.add(model)
        made: Schema = model.structure(self)
        self._open.discard(model)
        if name not in self.named:
            return made
        self.named[name] = {**made, "ref": name}
        return reference

    def _annotated(self, annotation: Any) -> Schema:  # noqa: ANN401 - a type
        """Return the schema of a type with marks, each of which may change what those before it have made."""
        source, *marks = get_args(annotation)
        made: Callable[[], Schema] = partial(self.of, source)
        for mark in marks:
            if hasattr(mark, "__get_pydantic_core_schema__"):
                made = partial(mark.__get_pydantic_core_schema__, source, partial(_handed, made))
        return made()

    def _union(self, annotation: Any) -> Schema:  # noqa: ANN401 - a type
        choices = [self.of(item) for item in get_args(annotation) if item is not NoneType]
        one = choices[0] if len(choices) == 1 else {"type": "union", "choices": choices}
        return {"type": "nullable", "schema": one} if NoneType in get_args(annotation) else one

    def _literal(self, annotation: Any) -> Schema:  # noqa: ANN401 - a type
        return {"type": "literal", "expected": list(get_args(annotation))}

    def _tuple(self, annotation: Any) -> Schema:  # noqa: ANN401 - a type
        item, _ = get_args(annotation)
        return {"type": "tuple", "items_schema": [self.of(item)], "variadic_item_index": 0}

    def _dict(self, annotation: Any) -> Schema:  # noqa: ANN401 - a type
        key, value = get_args(annotation)
        return {"type": "dict", "keys_schema": self.of(key), "values_schema": self.of(value)}


def _handed(made: Callable[[], Schema], source: Any) -> Schema:  # noqa: ANN401 - a type
    """Return what stands inside of a mark; pydantic hands it over as a function of the type."""
    del source
    return made()


_WAYS: dict[Any, Callable[[Schemas, Any], Schema]] = {
    Annotated: Schemas._annotated,  # noqa: SLF001 - the table of this class
    Union: Schemas._union,  # noqa: SLF001
    UnionType: Schemas._union,  # noqa: SLF001
    Literal: Schemas._literal,  # noqa: SLF001
    tuple: Schemas._tuple,  # noqa: SLF001
    dict: Schemas._dict,  # noqa: SLF001
}

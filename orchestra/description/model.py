"""Frozen classes with fields that pydantic's core validates: as pydantic's own, without pydantic.

A class declares its fields with annotations and `field`. Nothing is made of them before the class is first used: its
validator (`structure.py`) then, and pydantic's own model of it where a JSON Schema is asked for (`twins.py`).
"""

from __future__ import annotations

import sys
from functools import cache
from typing import TYPE_CHECKING, Any, ClassVar, Self, dataclass_transform

from orchestra.description.core import SchemaValidator
from orchestra.description.structure import structure_of

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.structure import Schema, Schemas

_UNWRITTEN: Any = type("Unwritten", (), {})()
_ABSENT = " | None"


class Field:
    """One field: how it is called and typed, what it is where nothing is written, and what users are told of it."""

    __slots__ = ("_module", "_written", "alias", "default", "description")

    def __init__(self, default: Any, alias: str | None, description: str | None) -> None:  # noqa: ANN401 - any value
        self.default = default
        self.alias = alias
        self.description = description
        self._module, self._written = "", ""

    def declare(self, module: str, written: str) -> None:
        """Set the annotation, as it is written in a module."""
        self._module, self._written = module, written

    @property
    def annotation(self) -> Any:  # noqa: ANN401 - a type
        """The type, with the marks that are annotated to it."""
        return _evaluated(self._module, self._written)

    def is_required(self) -> bool:
        """Tell whether a value must be written."""
        return self.default is _UNWRITTEN

    def structure(self, schemas: Schemas) -> Schema:
        """Return the schema of the field."""
        # Most fields may be None; `typing` takes longer to join the two types than all else takes.
        present = self._written.removesuffix(_ABSENT)
        schema = schemas.of(_evaluated(self._module, present))
        if present != self._written:
            schema = {"type": "nullable", "schema": schema}
        if not self.is_required():
            schema = {"type": "default", "schema": schema, "default": self.default}
        made = {"type": "model-field", "schema": schema}
        return made if self.alias is None else {**made, "validation_alias": self.alias}


@cache
def _evaluated(module: str, written: str) -> Any:  # noqa: ANN401 - a type
    names = vars(sys.modules[module])
    # Named, so that who watches what code does knows that it is ours.
    return names[written] if written in names else eval(compile(written, __file__, "eval"), names)  # noqa: S307


def field(
    *,
    default: Any = _UNWRITTEN,  # noqa: ANN401 - any value
    alias: str | None = None,
    description: str | None = None,
) -> Any:  # noqa: ANN401 - it stands for the value
    """Declare a field: its default, how users spell it, and what they are told of it."""
    return Field(default, alias, description)


class _Validator:
    """The validator of a class, which is made when somebody first validates."""

    def __get__(self, instance: object, owner: type[Model]) -> SchemaValidator:
        made = owner.validator = SchemaValidator(structure_of(owner))
        return made


@dataclass_transform(kw_only_default=True, frozen_default=True, field_specifiers=(field,))
class ClassWithFields(type):
    """Makes the classes: collects what each declares."""

    def __init__(cls, name: str, bases: tuple[type, ...], content: dict[str, Any]) -> None:
        """Those of the classes above come first, and one that is declared anew keeps its place."""
        super().__init__(name, bases, content)
        made: Any = cls
        found = dict(made.model_fields)
        for key, written in cls.__annotations__.items():
            if written.startswith("ClassVar["):
                found.pop(key, None)
                continue
            given = content.get(key, _UNWRITTEN)
            if given is not _UNWRITTEN:
                delattr(cls, key)
            found[key] = given if isinstance(given, Field) else Field(given, None, None)
            found[key].declare(cls.__module__, written)
        made.model_fields = found
        made.validator = _Validator()


class Model(metaclass=ClassWithFields):
    """A class with fields. Keys that are no fields are refused; values may be given by alias or by name.

    The slots are those that pydantic's core fills.
    """

    __slots__ = ("__dict__", "__pydantic_extra__", "__pydantic_fields_set__", "__pydantic_private__")

    model_fields: ClassVar[Mapping[str, Field]] = {}
    validator: ClassVar[SchemaValidator]
    if TYPE_CHECKING:

        @property
        def __pydantic_private__(self) -> dict[str, Any] | None: ...

    def __init__(self, **values: Any) -> None:  # noqa: ANN401 - any field
        self.validator.validate_python(values, self_instance=self)

    @classmethod
    def model_validate(cls, data: Any, *, context: Any = None) -> Self:  # noqa: ANN401 - whatever stands in the file
        """Return the object that data stand for. Raises `ValidationError`."""
        made: Self = cls.validator.validate_python(data, context=context)
        return made

    @classmethod
    def structure(cls, schemas: Schemas) -> Schema:
        """Return the schema of an object of the class."""
        fields = {name: item.structure(schemas) for name, item in cls.model_fields.items()}
        config = {"title": cls.__name__, "extra_fields_behavior": "forbid", "validate_by_name": True}
        return {
            "type": "model",
            "cls": cls,
            "schema": {"type": "model-fields", "model_name": cls.__name__, "fields": fields},
            # The older word for the same is for cores before 2.33.
            "config": {**config, "populate_by_name": True},
        }

    def model_copy(self, *, update: Mapping[str, Any] | None = None) -> Self:
        """Return an object like this one, with other values for some fields, which are not validated."""
        made = object.__new__(type(self))
        beside = self.__pydantic_private__
        object.__setattr__(made, "__dict__", {**self.__dict__, **(update or {})})
        object.__setattr__(made, "__pydantic_private__", None if beside is None else dict(beside))
        return made

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"cannot assign to field '{name}' of {type(self).__name__}: it is frozen")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"cannot delete field '{name}' of {type(self).__name__}: it is frozen")

    def __eq__(self, other: object) -> bool:
        """Tell whether the other one is of the same class, with the same values and the same beside them."""
        if other.__class__ is not self.__class__ or not isinstance(other, Model):
            return NotImplemented
        same = self.__dict__ == other.__dict__
        return same and self.__pydantic_private__ == other.__pydantic_private__

    def __hash__(self) -> int:
        return hash((type(self), *self.__dict__.values()))

    def __repr__(self) -> str:
        values = (f"{name}={value!r}" for name, value in self.__dict__.items())
        return f"{type(self).__name__}({', '.join(values)})"

"""The root of the models, and how it reads what a loader hands over.

A faulty key does not hide the rest of an entity: it is reported and left out, or stands for a value that is not known
where the entity cannot be without it. The entity is marked `faulty`, so that later stages report nothing that only
follows from it. Reporting itself is the loader's business (`Reader`).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, Protocol, Self, TypeVar

from orchestra.description.conflict import Conflict
from orchestra.description.core import PydanticCustomError, ValidationError
from orchestra.description.fields import Flag
from orchestra.description.model import Model, field
from orchestra.description.source import Keyed
from orchestra.description.text import Template
from orchestra.errors import Problem
from orchestra.location import Location, Matched, Span, location_of, new_location

if TYPE_CHECKING:
    from pydantic_core import ErrorDetails
    from pydantic_core.core_schema import ValidationInfo

    from orchestra.description.structure import Schema, Schemas

REPORTED = "reported"
_CONDITIONS = ("if", "unless")
_HOLDING = frozenset({"children", "file"})  # the keys of what holds other actions

_EntityT = TypeVar("_EntityT", bound="Entity")

set_beside: Callable[[Model, dict[str, Any]], None] = vars(Model)["__pydantic_private__"].__set__
set_values: Callable[[Model, dict[str, Any]], None] = vars(Model)["__dict__"].__set__


class FaultReader(Protocol):
    """The part of a loader that entities talk to."""

    def keys(self, known: frozenset[str], mapping: Keyed, required: frozenset[str] = ...) -> Keyed:
        """Return the mapping with no key but those that are known; others are reported.

        `required` are those of them that cannot be missing.
        """

    def faults(self, mapping: Keyed, errors: Sequence[ErrorDetails]) -> set[str]:
        """Report what is wrong with the values, return the keys that are concerned."""

    def conflict(self, mapping: Keyed, conflict: Conflict) -> None:
        """Report keys that cannot stand together."""


class Entity(Model):
    """Something a user writes: an action, or a part of one."""

    @classmethod
    def at(
        cls,
        span: Span,
        *,
        origin: Any = None,  # noqa: ANN401 - any object
        faults: tuple[Problem, ...] = (),
        **values: Any,  # noqa: ANN401 - any field
    ) -> Self:
        """Return the entity that Python code made at a place, from values that need no reading.

        `faults` are what was wrong with values that have been left out. Raises `ValidationError`.
        """
        # As the constructor does, without its detours.
        entity: Self = cls.validator.validate_python(values)
        set_beside(
            entity,
            {"span": span, "origin": origin, "faults": faults}
            if faults
            else {"span": span, "origin": origin},
        )
        return entity

    @classmethod
    def made(cls, span: Span, values: dict[str, Any], origin: Any = None) -> Self:  # noqa: ANN401 - any object
        """Return the same as `at` for values that nothing can be wrong with, by the names of the fields.

        That is so for texts that are read and have no words of their own, and for parts that are made. Code in Python
        makes thousands of these, and the validator takes four times as long.
        """
        entity = object.__new__(cls)
        object.__setattr__(entity, "__dict__", {**cls._unwritten(), **values})
        set_beside(entity, {"span": span, "origin": origin})
        return entity

    @classmethod
    @cache
    def _unwritten(cls) -> dict[str, Any]:
        """Return the fields with what each is where nothing is written."""
        return {
            name: None if entry.is_required() else entry.default for name, entry in cls.model_fields.items()
        }

    @property
    def _beside(self) -> dict[str, Any]:
        """What is known of the entity beside what was written; it is compared and copied with it."""
        beside = self.__pydantic_private__
        if beside is None:
            beside = {}
            set_beside(self, beside)
        return beside

    @property
    def span(self) -> Span:
        """Where the entity stands."""
        beside: Any = (
            self.__pydantic_private__
        )  # where there is none, nobody has said where the entity stands
        span: Any = beside["span"] or self._settle()
        placed: Span = span
        return placed

    def _settle(self) -> Span | None:
        """Work out the place of an entity in a text that was matched."""
        beside = self.__pydantic_private__
        at: tuple[Matched, int] | None = None if beside is None else beside.pop("at", None)
        if beside is None or at is None:
            return None
        span = beside["span"] = at[0].span(at[1])
        return span

    @property
    def faulty(self) -> bool:
        """Whether a part of the entity was wrong and has been left out."""
        beside = self.__pydantic_private__
        return beside is not None and ("faulty" in beside or bool(beside.get("faults")))

    @property
    def faults(self) -> tuple[Problem, ...]:
        """What was wrong where nobody could report it: in Python code. The visit does."""
        beside = self.__pydantic_private__
        faults: tuple[Problem, ...] = () if beside is None else beside.get("faults", ())
        return faults

    @property
    def origin(self) -> Any:  # noqa: ANN401 - any object
        """The object of a Python launch file that the entity was made from."""
        beside = self.__pydantic_private__
        return None if beside is None else beside.get("origin")

    def location(self, included_from: tuple[Span, ...]) -> Location:
        """Return where the entity stands, in a file that these includes have led to."""
        beside: Any = self.__pydantic_private__
        at: tuple[Matched, int] | None = beside.get("at")
        return new_location(self.span, included_from) if at is None else location_of(*at, included_from)

    def mark_faulty(self) -> None:
        """Say that a part of the entity was wrong and has been left out."""
        self._beside["faulty"] = True

    def __eq__(self, other: object) -> bool:
        """Tell whether the other one says the same in the same place."""
        if isinstance(other, Entity):
            self._settle()
            other._settle()
        return super().__eq__(other)

    __hash__ = Model.__hash__

    def conflict(self) -> Conflict | None:
        """Return why the keys that stand here cannot stand together, None where they can."""
        return None

    @classmethod
    @cache
    def known_keys(cls) -> frozenset[str]:
        """Return the keys that a user may write."""
        return frozenset(entry.alias or name for name, entry in cls.model_fields.items())

    @classmethod
    @cache
    def required_keys(cls) -> frozenset[str]:
        """Return the keys that a user must write."""
        return frozenset(
            entry.alias or name for name, entry in cls.model_fields.items() if entry.is_required()
        )

    @classmethod
    def required_beside(cls, keys: Collection[str]) -> frozenset[str]:
        """Return the keys that a user must write who has written these."""
        del keys
        return cls.required_keys()

    @classmethod
    def completed(cls, data: Any) -> Any:  # noqa: ANN401 - whatever stands in the file
        """Return the values of an entity with those that others stand for."""
        return data

    @classmethod
    def structure(cls, schemas: Schemas) -> Schema:
        """Return the schema of an entity."""
        function = {"type": "with-info", "function": cls._read}
        return {"type": "function-wrap", "function": function, "schema": super().structure(schemas)}

    @classmethod
    def _read(cls, data: Any, handler: Callable[[Any], Self], info: ValidationInfo) -> Self:  # noqa: ANN401 - whatever stands in the file
        reader: FaultReader | None = info.context
        if not isinstance(data, Keyed):  # no loader
            made = handler(cls.completed(data))
            return made if reader is not None else _sound(made)
        if reader is None:
            raise TypeError("mappings are read with a loader as the validation context")
        if data.read is not None and isinstance(data.read, cls):
            return data.read  # before, when something beside it was wrong
        known = cls.known_keys()
        mapping = data if data.keys() <= known else reader.keys(known, data, cls.required_beside(data))
        faulty = mapping.lossy
        values = dict(mapping)
        try:
            entity = handler(cls.completed(values))
        except ValidationError as error:
            # Here, because only mistakes need it.
            from orchestra.description.remaining import sound_values  # noqa: PLC0415

            faulty, details = True, _details(error)
            wrong = reader.faults(mapping, details)
            values = sound_values(mapping, wrong, details)
            entity = cls._again(values, mapping, handler)
        if (conflict := entity.conflict()) is not None:
            certain = len(conflict.keys) > 1 and mapping.keys() >= set(conflict.keys)
            if not faulty or (certain and (conflict.keys == _CONDITIONS or not mapping.lossy)):
                reader.conflict(mapping, conflict)
            faulty = True
            entity = cls._again(cls._parted(values, conflict, mapping.head), mapping, handler)
            if entity.conflict() is not None:
                raise PydanticCustomError(REPORTED, "reported")
        set_beside(entity, {"span": mapping.head, "faulty": True} if faulty else {"span": mapping.head})
        data.read = entity
        return entity

    @classmethod
    def _again(cls, values: dict[str, Any], mapping: Keyed, handler: Callable[[Any], Self]) -> Self:
        """Read the entity again without what has been reported; what it cannot be without is not known."""
        unknown = Template((), "", mapping.head, faulty=True)
        needed = dict.fromkeys(cls.required_beside(mapping), unknown)
        try:
            return handler(cls.completed({**needed, **values}))
        except ValidationError:
            raise PydanticCustomError(REPORTED, "reported") from None

    @classmethod
    def _parted(cls, values: dict[str, Any], conflict: Conflict, head: Span) -> dict[str, Any]:
        """Return the values that are left where keys that cannot stand together have been taken out."""
        del head
        return {key: value for key, value in values.items() if key not in conflict.keys}


class Conditional(Entity):
    """What is left out where its condition says so."""

    if_: Flag | None = field(
        default=None, alias="if", description="Carry the action out only if this is true."
    )
    unless: Flag | None = field(default=None, description="Carry the action out only if this is false.")

    def conflict(self) -> Conflict | None:
        """Return a conflict between the two conditions."""
        if self.if_ is None or self.unless is None:
            return None
        return Conflict("`if` and `unless` cannot stand on one action", _CONDITIONS)

    @classmethod
    def _parted(cls, values: dict[str, Any], conflict: Conflict, head: Span) -> dict[str, Any]:
        """Return what is left without two conditions: of what holds others nobody knows whether it is carried out."""
        left = super()._parted(values, conflict, head)
        if conflict.keys == _CONDITIONS and not cls.known_keys().isdisjoint(_HOLDING):
            left["if"] = Template((), "", head, faulty=True)
        return left


class Action(Conditional):
    """What a launch description is made of."""


def matched_entity(model: type[_EntityT], values: dict[str, Any], matched: Matched, group: int) -> _EntityT:
    """Return an entity of a file: all of its fields, which nothing is wrong with. It stands where a group does."""
    entity = object.__new__(model)
    set_values(entity, values)
    set_beside(entity, {"span": None, "at": (matched, group)})
    return entity


def _sound(entity: _EntityT) -> _EntityT:
    """Refuse an entity whose keys cannot stand together."""
    if (conflict := entity.conflict()) is not None:
        raise PydanticCustomError("conflict", "{conflict}", {"conflict": conflict.reason})
    return entity


def _details(error: ValidationError) -> Sequence[ErrorDetails]:
    return error.errors(include_url=False)

"""Models of pydantic as declarations of parameters: pydantic itself validates."""

from __future__ import annotations

import re
from functools import partial
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel, PydanticUserError, ValidationError

from orchestra.dataclass import dataclass
from orchestra.declared.judging import missing
from orchestra.declared.model import Fault
from orchestra.declared.shape import Level, level, ros_types
from orchestra.declared.structured import faults_with, undeclared
from orchestra.declared.texts import nearest_text
from orchestra.declared.typing_of_values import rewritten
from orchestra.description.plugins import keep_away
from orchestra.errors import Code

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.declared.model import ParameterSchema
    from orchestra.declared.shape import Lookup
    from orchestra.declared.structured import Structured
    from orchestra.errors import Problems
    from orchestra.resolve.model import NamedSchema
    from orchestra.values import ParameterValue

keep_away()

_QUOTED = re.compile(r"'([^']*)'")
_OF_CODE = re.compile(r"^(Value error|Assertion failed), ")  # what a validator of the user's raises
_OF_TYPES = re.compile(r".*_(type|parsing|from_float)$")


def read_model(named: NamedSchema, problems: Problems) -> ParameterSchema | None:
    """Return what a class declares, None where it is no model of pydantic (which is reported)."""
    model = named.model
    if not isinstance(model, type) or not issubclass(model, BaseModel):
        told = f"'{named.text}' is no model of pydantic"
        problems.error(Code.BROKEN_DECLARATION, told, named.location)
        return None
    try:
        schema = model.model_json_schema()
    except (
        PydanticUserError
    ):  # it has fields that JSON cannot have: what its parts are called is not known then
        schema = {}
    return _Model(model, level((schema, _inside(schema))))


def _inside(schema: dict[str, Any]) -> Lookup:
    """Return what looks up the definitions of a schema that pydantic has made."""

    def lookup(ref: str) -> tuple[Any, Lookup]:
        return schema.get("$defs", {}).get(ref.removeprefix("#/$defs/"), {}), lookup

    return lookup


@dataclass(frozen=True, slots=True)
class _Model:
    model: type[BaseModel]
    root: Level

    def faults(self, values: Mapping[str, ParameterValue]) -> Iterator[Fault]:
        closed = self.model.model_config.get("extra") != "allow"
        return faults_with(values, self.root, partial(_validated, self.model), closed=closed)


def _validated(model: type[BaseModel], found: Structured) -> list[Fault]:
    """Return what the model says; what it raises beside that is its fault, but shown where it is used."""
    try:
        model.model_validate(found.tree)
    except ValidationError as error:
        faults = [_fault(dict(item), found) for item in error.errors(include_url=False)]
        return list({(fault.name, fault.item, fault.kind): fault for fault in reversed(faults)}.values())[
            ::-1
        ]
    except Exception as error:  # noqa: BLE001 - code of the user
        told = f"the model '{model.__name__}' fails: {type(error).__name__}: {error}"
        return [Fault("value", "", told)]
    return []


def _fault(error: dict[str, Any], found: Structured) -> Fault:
    way = _way(error["loc"], found.tree)
    name, item = found.named(way)
    kind = error["type"]
    if kind == "missing":
        if name in found.values:  # a list that is there, of a fixed length
            return Fault("value", name, f"'{name}' has too few items")
        return missing(name)
    if kind == "extra_forbidden":
        inside = [other for other in found.values if other == name or other.startswith(f"{name}.")]
        return undeclared(inside[0] if inside else name, found, certain=True)
    told = _OF_CODE.sub("", error["msg"])
    told = told[:1].lower() + told[1:]
    told = f"'{name}': {told}" if name else f"the parameters: {told}"
    if _OF_TYPES.fullmatch(kind):
        return Fault("type", name, told, _retyped(name, error["input"], found), item)
    return Fault("value", name, told, _meant(error), item)


def _way(loc: tuple[int | str, ...], tree: Any) -> tuple[int | str, ...]:  # noqa: ANN401 - data
    """Return the steps of a place that lead into the data: pydantic puts the names of alternatives between them."""
    way: list[int | str] = []
    at = tree
    for position, step in enumerate(loc):
        last = position == len(loc) - 1
        if isinstance(at, dict) and (step in at or last):
            at = at.get(step)
        elif isinstance(at, list) and isinstance(step, int) and step < len(at):
            at = at[step]
        else:
            continue
        way.append(step)
    return tuple(way)


def _retyped(name: str, value: Any, found: Structured) -> str | None:  # noqa: ANN401 - data
    """Return how a value should have been written."""
    place = found.places.get(name)
    if place is None or place.said is None or isinstance(value, dict):
        return None
    return rewritten(tuple(value) if isinstance(value, list) else value, ros_types(place.said)[0])


def _meant(error: dict[str, Any]) -> str | None:
    """Return the nearest of the texts that a value may be."""
    expected = error.get("ctx", {}).get("expected")
    return nearest_text(error["input"], _QUOTED.findall(expected)) if isinstance(expected, str) else None

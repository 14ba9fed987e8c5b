"""JSON Schemas that say more than a table of parameters can, validated by the library `jsonschema`."""

from __future__ import annotations

import re
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote, urlparse

from orchestra.dataclass import dataclass
from orchestra.declared.documents import read_document
from orchestra.declared.judging import missing
from orchestra.declared.model import Fault, ParameterSchema
from orchestra.declared.plain_schema import NUMERIC
from orchestra.declared.shape import Level, level
from orchestra.declared.structured import faults_with, undeclared
from orchestra.declared.texts import nearest_text
from orchestra.declared.typing_of_values import rewritten
from orchestra.errors import Code, Problems
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.declared.documents import Document, Way
    from orchestra.declared.shape import Lookup
    from orchestra.declared.structured import Structured
    from orchestra.values import ParameterValue

_ABOUT_NAMES = ("additionalProperties", "unevaluatedProperties", "propertyNames")


def read_validated(document: Document, problems: Problems) -> ParameterSchema | None:
    """Return what a schema says of parameters, None where it is none (which is reported)."""
    from jsonschema.validators import Draft202012Validator, validator_for  # noqa: PLC0415 - few schemas need it

    draft = document.data.get("$schema", "")
    kind = validator_for(document.data if isinstance(draft, str) else {}, default=Draft202012Validator)
    faults = list(kind(kind.META_SCHEMA).iter_errors(document.data))
    for error in faults:
        at = document.at(tuple(error.absolute_path))
        told = f"no JSON Schema: {error.message}"
        problems.error(Code.BROKEN_DECLARATION, told, at, suggestion=_meant_word(error))
    if faults:
        return None
    registry = _registry(document)
    resolver = registry.resolver(document.data.get("$id", "") if isinstance(document.data, dict) else "")
    dead = _refuse_dead_references(document, resolver, problems)
    if _refuse_patterns(document, problems) or dead:
        return None
    root = level((document.data, partial(_lookup, resolver)))
    return _Schema(kind(document.data, registry=registry), root)


def _meant_word(error: Any) -> str | None:  # noqa: ANN401 - of the library
    """Return the type that a word of a schema probably means."""
    is_type = list(error.absolute_path)[-1:] == ["type"] and isinstance(error.instance, str)
    return nearest(error.instance, (*NUMERIC, "array", "object", "null")) if is_type else None


@dataclass(frozen=True, slots=True)
class _Schema:
    validator: Any
    root: Level

    def faults(self, values: Mapping[str, ParameterValue]) -> Iterator[Fault]:
        return faults_with(values, self.root, self._found)

    def _found(self, found: Structured) -> Iterator[Fault]:
        for error in self._errors(found):
            yield from _faults_of(error, found)

    def _errors(self, found: Structured) -> list[Any]:
        try:
            return list(self.validator.iter_errors(found.tree))
        except RecursionError:
            return []  # it refers to itself without end, so that it says nothing


def _refuse_patterns(document: Document, problems: Problems) -> bool:
    """Report what is no regular expression; return whether there is any."""
    wrong = False
    for pattern, way, key in _patterns(document.data):
        try:
            re.compile(pattern)
        except re.error as error:
            wrong = True
            told = f"'{pattern}' is no regular expression: {error}"
            problems.error(Code.BROKEN_DECLARATION, told, document.at(way, key=key))
    return wrong


def _patterns(data: Any, way: Way = ()) -> Iterator[tuple[str, Way, bool]]:  # noqa: ANN401 - whatever a file holds
    """Yield the patterns of a document, and whether each is a key."""
    if isinstance(data, dict):
        if isinstance(data.get("pattern"), str):
            yield data["pattern"], (*way, "pattern"), False
        named = data.get("patternProperties")
        for name in named if isinstance(named, dict) else ():
            yield str(name), (*way, "patternProperties", name), True
        for key, value in data.items():
            yield from _patterns(value, (*way, key))
    elif isinstance(data, list):
        for index, value in enumerate(data):
            yield from _patterns(value, (*way, index))


def _faults_of(error: Any, found: Structured) -> Iterator[Fault]:  # noqa: ANN401 - of the library
    """Yield what one error of the library means for parameters."""
    name, item = found.named(tuple(error.absolute_path))
    above = f"{name}." if name else ""
    if error.validator == "required":
        for other in error.validator_value:
            if other not in error.instance:
                yield missing(f"{above}{other}")
    elif error.validator in _ABOUT_NAMES:
        below = [other for other in found.values if other.startswith(above) and not found.places[other].known]
        for other in below:
            yield undeclared(other, found, certain=True)
        if not below:
            yield Fault("undeclared", name, f"'{name}': {error.message}")
    elif error.validator == "type":
        yield Fault("type", name, _about(name, error.message), _retyped(error), item)
    else:
        yield Fault("value", name, _about(name, error.message), _meant(error), item)


def _about(name: str, message: str) -> str:
    return f"'{name}': {message}" if name else f"the parameters: {message}"


def _retyped(error: Any) -> str | None:  # noqa: ANN401 - of the library
    """Return how a number should have been written that is a text, or the other way round."""
    words = error.validator_value if isinstance(error.validator_value, list) else [error.validator_value]
    types = tuple(NUMERIC[word][0] for word in words if word in NUMERIC)
    value = tuple(error.instance) if isinstance(error.instance, list) else error.instance
    return None if isinstance(value, dict) else rewritten(value, types)


def _meant(error: Any) -> str | None:  # noqa: ANN401 - as above
    choices = {"enum": error.validator_value, "const": [error.validator_value]}.get(error.validator, [])
    return nearest_text(error.instance, [item for item in choices if isinstance(item, str)])


def _registry(document: Document) -> Any:  # noqa: ANN401 - of the library
    from referencing import Registry, Resource  # noqa: PLC0415 - as above
    from referencing.exceptions import NoSuchResource  # noqa: PLC0415
    from referencing.jsonschema import DRAFT202012  # noqa: PLC0415

    def retrieve(uri: str) -> Any:  # noqa: ANN401 - as above
        """Return another file; nothing is fetched from anywhere: what is elsewhere may lie beside this file."""
        parsed = urlparse(uri)
        name = unquote(parsed.path)
        path = Path(document.path).parent / (name if parsed.scheme in ("", "file") else Path(name).name)
        read = read_document(str(path), None, Problems()) if path.is_file() else None
        if read is None:
            raise NoSuchResource(ref=uri)  # type: ignore[call-arg]  # made by attrs, whose types are not seen
        return Resource.from_contents(read.data, default_specification=DRAFT202012)

    resource = Resource.from_contents(document.data, default_specification=DRAFT202012)
    own = document.data.get("$id", "") if isinstance(document.data, dict) else ""
    registry = Registry(retrieve=retrieve)  # type: ignore[call-arg]  # as above
    return registry.with_resource("", resource).with_resource(own, resource)


def _lookup(resolver: Any, ref: str) -> tuple[Any, Lookup]:  # noqa: ANN401 - of the library
    """Return what a reference refers to. All that a document itself holds have been looked up before."""
    from referencing.exceptions import Unresolvable  # noqa: PLC0415 - as above

    try:
        found = resolver.lookup(ref)
    except Unresolvable:
        return {}, partial(_lookup, resolver)
    return found.contents, partial(_lookup, found.resolver)


def _refuse_dead_references(document: Document, resolver: Any, problems: Problems) -> bool:  # noqa: ANN401 - as above
    """Report references that lead nowhere; return whether there are any."""
    from referencing.exceptions import Unresolvable  # noqa: PLC0415 - as above

    dead = False
    for ref, way in _references(document.data):
        try:
            resolver.lookup(ref)
        except Unresolvable:
            dead = True
            told = f"the reference '{ref}' leads nowhere"
            problems.error(Code.BROKEN_DECLARATION, told, document.at(way))
    return dead


def _references(data: Any, way: Way = ()) -> Iterator[tuple[str, Way]]:  # noqa: ANN401 - whatever a file holds
    """Yield the references of a document, but for those below an `$id` of their own."""
    if isinstance(data, dict) and not (way and "$id" in data):
        if isinstance(data.get("$ref"), str):
            yield data["$ref"], (*way, "$ref")
        for key, value in data.items():
            yield from _references(value, (*way, key))
    elif isinstance(data, list):
        for index, value in enumerate(data):
            yield from _references(value, (*way, index))

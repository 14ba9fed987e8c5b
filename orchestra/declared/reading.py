"""The ways to declare the parameters of a node: a reader for each, behind one table."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol

from orchestra.dataclass import dataclass
from orchestra.declared.documents import Document, read_document
from orchestra.declared.kinds import is_definition, is_schema
from orchestra.errors import Code, Problems
from orchestra.witness.once import once

if TYPE_CHECKING:
    from orchestra.declared.model import ParameterSchema
    from orchestra.location import Location
    from orchestra.resolve.model import NamedSchema


class Reader(Protocol):
    """Reads one kind of file; what is wrong with it is reported."""

    def __call__(self, document: Document, problems: Problems, /) -> ParameterSchema | None:
        """Return what the file declares, None where nothing can be made of it."""


@dataclass(frozen=True, slots=True)
class Way:
    """One way to declare parameters in a file: whether a file is of it, and what reads it, in a module of its own."""

    is_it: Callable[[Any], bool]
    module: str
    name: str

    @property
    def read(self) -> Reader:
        """What reads it: imported when the first such file is read."""
        reader: Reader = getattr(import_module(self.module), self.name)
        return reader


_SCHEMA: Final = Way(is_schema, "orchestra.declared.json_schema", "read_schema")
_DEFINITION: Final = Way(is_definition, "orchestra.declared.generated", "read_definition")
# The first that knows a file reads it.
WAYS: Final = (_SCHEMA, _DEFINITION)


def read_named(named: NamedSchema, problems: Problems) -> ParameterSchema | None:
    """Return the schema that a description names."""
    if named.path is not None:
        return read_file(named.path, named.location, problems)
    # Here, because hardly any description names one.
    from orchestra.declared.pydantic_model import read_model  # noqa: PLC0415

    return read_model(named, problems)


def read_file(path: str, named_at: Location | None, problems: Problems) -> ParameterSchema | None:
    """Return the schema in a file, whatever way it is written; `named_at` is where a description names it."""
    return once(("declaration", path), lambda: _sound_now(path)) or _read(path, named_at, problems)


def _sound_now(path: str) -> ParameterSchema | None:
    try:
        content = Path(path).read_bytes()
    except OSError:
        content = b""
    return _sound(path, content)


@lru_cache(maxsize=64)  # by content: many nodes are declared in the same file
def _sound(path: str, content: bytes) -> ParameterSchema | None:
    """Return the schema in a file in which nothing is wrong, None for one that may lean on other files."""
    if b"$ref" in content:
        return None
    found = Problems()
    schema = _read(path, None, found)
    return None if len(found) else schema


def _read(path: str, named_at: Location | None, problems: Problems) -> ParameterSchema | None:
    document = read_document(path, named_at, problems)
    if document is None:
        return None
    way = next((way for way in WAYS if way.is_it(document.data)), None)
    if way is not None:
        return way.read(document, problems)
    if _may_be_definition(document.data):
        return _DEFINITION.read(document, problems)  # which says what is wrong with it
    told = "this is neither a JSON Schema of an object nor a definition of generate_parameter_library"
    problems.error(Code.BROKEN_DECLARATION, told, document.at())
    return None


def _may_be_definition(data: Any) -> bool:  # noqa: ANN401 - whatever a file holds
    """Return whether something in it has the type of a parameter."""
    waiting = [data]
    while waiting:
        item = waiting.pop()
        if isinstance(item, dict):
            if isinstance(item.get("type"), str) and len(item) < 10 and item is not data:  # noqa: PLR2004 - the keys of a parameter
                return "ros__parameters" not in item
            waiting += item.values()
    return False

"""What is annotated to the type of a field: how its values are read, and what an editor is told of them.

Marks speak as pydantic asks them to, for the schema of the core and for JSON Schema; of pydantic they need nothing.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic_core import CoreSchema


def read_with(read: Callable[[Any, Any], Any]) -> CoreSchema:
    """Return the schema of values that a function reads, whatever their type."""
    return {"type": "function-plain", "function": {"type": "with-info", "function": read}}


@dataclass(frozen=True, slots=True)
class Plain:
    """Values are read by a function, and by nothing else."""

    read: Callable[[Any, Any], Any]

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:  # noqa: ANN401 - pydantic's own signature
        """Return how the core reads it."""
        del source, handler
        return read_with(self.read)


@dataclass(frozen=True, slots=True, eq=False)
class Told:
    """An editor is told this JSON Schema, whatever the type is."""

    schema: Mapping[str, Any]

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return how an editor checks it."""
        del schema, handler
        return dict(self.schema)


@dataclass(frozen=True, slots=True)
class NotEmpty:
    """At least one item stands in a list, or one key in a mapping."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:  # noqa: ANN401 - as above
        """Return how the core reads it."""
        limited: CoreSchema = {**handler(source), "min_length": 1}
        return limited


@dataclass(frozen=True, slots=True)
class Instance:
    """Values are objects of the class that is annotated, made already."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:  # noqa: ANN401 - as above
        """Return how the core reads it."""
        del handler
        return {"type": "is-instance", "cls": source}

"""A part that may be written as one text, which is then the value of one of its keys: `restart: always`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.description.source import Keyed, Written
from orchestra.description.text import Template

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic_core import CoreSchema


@dataclass(frozen=True, slots=True)
class Short:
    """Lets a text stand for the whole part, as the value of `key`. Stands in `Annotated[Part, ...]`."""

    key: str

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:  # noqa: ANN401 - pydantic's own signature
        """Return how the core reads it."""
        function = {"type": "no-info", "function": self._whole}
        read: CoreSchema = {"type": "function-before", "function": function, "schema": handler(source)}
        return read

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return how an editor checks it."""
        whole = handler(schema)
        value = handler.resolve_ref_schema(whole)["properties"][self.key]
        return {"anyOf": [value, whole]}

    def _whole(self, value: Any) -> Any:  # noqa: ANN401 - whatever stands in the file
        """Return the part that a text is short for; anything else as it is."""
        if not isinstance(value, Written | Template) or (isinstance(value, Written) and value.null):
            return value
        whole = Keyed(value.span, value.span)
        whole.put(self.key, value, value.span)
        return whole

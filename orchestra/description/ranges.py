"""Numbers within bounds, as types of fields: a constant is checked when it is read, any other when it is resolved."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.description.fields import constant_of, meant_seconds, meant_whole
from orchestra.description.marks import read_with

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
    from pydantic_core import CoreSchema


@dataclass(frozen=True, slots=True)
class Range:
    """Numbers from `least` to `most`, both included; `least` itself not where they are `above` it.

    `wanted` says it to people. Stands in `Annotated[Template, ...]`.
    """

    wanted: str
    least: float
    most: float = math.inf
    above: bool = False
    whole: bool = False

    def read(self, text: str) -> float | None:
        """Return the number that a text is, None where it is none of these."""
        try:
            number = int(text) if self.whole else float(text)
        except ValueError:
            return None
        if not math.isfinite(number) or not self.least <= number <= self.most:
            return None
        return None if self.above and number == self.least else number

    def _meant(self, text: str) -> str | None:
        meant = (meant_whole if self.whole else meant_seconds)(text)
        return meant if meant is not None and self.read(meant) is not None else None

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:  # noqa: ANN401 - pydantic's own signature
        """Return how the core reads it."""
        del source, handler
        return read_with(
            constant_of(self.wanted, lambda text: self.read(text) is not None, meant=self._meant)
        )

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        """Return how an editor checks it."""
        del schema, handler
        bounds = {"exclusiveMinimum" if self.above else "minimum": _plain(self.least)}
        if math.isfinite(self.most):
            bounds["maximum"] = _plain(self.most)
        number = {"type": "integer" if self.whole else "number", **bounds}
        digits = "[+-]?[0-9]+" if self.whole else "[0-9.eE+-]+"
        return {"anyOf": [number, {"type": "string", "pattern": rf"\$\(|^{digits}$"}]}


def _plain(number: float) -> float:
    return int(number) if number == int(number) else number


GROWTH = Range("a factor of 1 or more", 1)
SHARE = Range("a share from 0 to 1", 0, 1)
RATE = Range("a number of messages a second", 0, above=True)
SOME_SECONDS = Range("a number of seconds above 0", 0, above=True)
INTERVAL = Range("a number of seconds, at least 0.01", 0.01)
BUDGET = Range("a whole number, 0 or more", 0, whole=True)
COUNT = Range("a whole number above 0", 1, whole=True)
NICE = Range("a whole number from -20 to 19", -20, 19, whole=True)
PRIORITY = Range("a whole number from 1 to 99", 1, 99, whole=True)

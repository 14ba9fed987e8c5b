"""The table of schemas: what `orchestra schema NAME` prints and `schemas/NAME.schema.json` holds."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Final

from orchestra.cli.schemas.parameters import parameters_schema
from orchestra.cli.schemas.records import record_schema
from orchestra.errors import Problem
from orchestra.events import Event
from orchestra.plan.model import VERSION, Plan

if TYPE_CHECKING:
    from collections.abc import Callable


def _launch() -> dict[str, Any]:
    from orchestra.description.schema import launch_schema  # noqa: PLC0415 - pydantic, which the others do not need

    return launch_schema()


def _plan() -> dict[str, Any]:
    schema = record_schema(Plan)
    return {**schema, "properties": {**schema["properties"], "version": {"const": VERSION}}}


SCHEMAS: Final[dict[str, Callable[[], dict[str, Any]]]] = {
    "launch": _launch,
    "params": parameters_schema,
    "plan": _plan,
    "event": lambda: record_schema(Event),
    "problem": lambda: record_schema(Problem),
}


def schema_text(name: str) -> str:
    """Return the text of one schema, line break at its end included."""
    return json.dumps(SCHEMAS[name](), indent=2, ensure_ascii=False) + "\n"

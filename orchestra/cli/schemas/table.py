"""The table of schemas: what `orchestra schema NAME` prints and a file in `schemas/` holds."""

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


def _difference() -> dict[str, Any]:
    from orchestra.cli.planning.comparison import VERSION as FORM  # noqa: PLC0415 - what plans need, which others do not
    from orchestra.plan.difference.model import Difference  # noqa: PLC0415 - as above

    schema = record_schema(Difference)
    named = {"version": {"const": FORM}, "before": {"type": "string"}, "after": {"type": "string"}}
    return {
        **schema,
        "properties": {**named, **schema["properties"]},
        "required": [*named, *schema["required"]],
    }


def _explanation() -> dict[str, Any]:
    from orchestra.cli.planning.explanation import VERSION as FORM  # noqa: PLC0415 - as above
    from orchestra.plan.explained import Explanation  # noqa: PLC0415 - as above

    listed = record_schema(tuple[Explanation, ...])
    return {
        "$schema": listed.pop("$schema"),
        "description": "What `orchestra plan FILE --explain SUBJECT --format json` prints.",
        "type": "object",
        "properties": {
            "version": {"const": FORM},
            "explained": {key: value for key, value in listed.items() if key != "$defs"},
        },
        "required": ["version", "explained"],
        "additionalProperties": False,
        "$defs": listed["$defs"],
    }


def _problem() -> dict[str, Any]:
    listed = record_schema(tuple[Problem, ...])
    one = {"$ref": "#/$defs/Problem"}
    return {
        "$schema": listed["$schema"],
        "title": "Problem report",
        "description": "What `orchestra check --format json` prints, a list of problems; or one of them.",
        "anyOf": [{"type": "array", "items": one}, one],
        "$defs": listed["$defs"],
    }


SCHEMAS: Final[dict[str, Callable[[], dict[str, Any]]]] = {
    "launch": _launch,
    "params": parameters_schema,
    "plan": _plan,
    "difference": _difference,
    "explanation": _explanation,
    "event": lambda: record_schema(Event),
    "problem": _problem,
}


def _launch_xml() -> str:
    from orchestra.cli.schemas.xml_launch import xml_schema_text  # noqa: PLC0415 - as above

    return xml_schema_text()


# What is no JSON Schema: XML Schema for launch files in XML.
OTHERS: Final[dict[str, Callable[[], str]]] = {"launch-xml": _launch_xml}

# The file below `schemas/` that holds each.
FILES: Final = {
    **{name: f"{name}.schema.json" for name in SCHEMAS},
    "launch-xml": "launch.xsd",
}


def schema_text(name: str) -> str:
    """Return the text of one schema, line break at its end included."""
    if name in OTHERS:
        return OTHERS[name]()
    return json.dumps(SCHEMAS[name](), indent=2, ensure_ascii=False) + "\n"

"""The JSON Schema of launch files in YAML, made of the models: an editor completes and explains what they accept."""

from __future__ import annotations

from typing import Any

from pydantic.json_schema import GenerateJsonSchema

from orchestra.description.actions import ACTIONS, model_of

_DRAFT = "https://json-schema.org/draft/2020-12/schema"


def launch_schema() -> dict[str, Any]:
    """Return the schema of a YAML launch file."""
    definitions: dict[str, Any] = {}
    actions = []
    for name in ACTIONS:
        schema = _schema_of(name)
        definitions.update(schema.pop("$defs", {}))
        definitions[name] = schema
        content: dict[str, Any] = {"$ref": f"#/$defs/{name}"}
        if not schema.get("required"):
            content = {"anyOf": [content, {"type": "null"}]}
        if "children" in schema["properties"] and schema.get("required", ["children"]) == ["children"]:
            content = {"anyOf": [content, {"$ref": "#/$defs/Actions"}]}
        actions.append(_single(name, content, schema.get("description")))
    definitions["Actions"] = {"type": "array", "items": {"anyOf": actions}}
    root = {
        "anyOf": [
            {"$ref": "#/$defs/Actions"},
            {
                "type": "object",
                "properties": {"deprecated": {"type": "string"}, "children": {"$ref": "#/$defs/Actions"}},
                "required": ["children"],
                "additionalProperties": False,
            },
        ]
    }
    return {
        "$schema": _DRAFT,
        "title": "Launch file",
        "description": "A ROS 2 launch file in YAML, with Orchestra's extensions.",
        "type": "object",
        "properties": {"launch": root},
        "required": ["launch"],
        "additionalProperties": False,
        "$defs": dict(sorted(definitions.items())),
    }


def _single(name: str, content: dict[str, Any], description: str | None) -> dict[str, Any]:
    """Return the schema of a list item: a mapping with the action's name as its one key."""
    return {
        "type": "object",
        "description": description or name,
        "properties": {name: content},
        "required": [name],
        "additionalProperties": False,
    }


class _WithoutTitles(GenerateJsonSchema):
    """Leaves out what pydantic makes of the names of fields: it says nothing that the key does not."""

    def field_title_should_be_set(self, schema: Any) -> bool:  # noqa: ANN401 - pydantic's own signature
        del schema
        return False


def _schema_of(name: str) -> dict[str, Any]:
    """Return the schema of an action, keys that may be left out without their null."""
    model = model_of(name)
    assert model is not None  # noqa: S101 - the name is from the table
    schema = model.model_json_schema(schema_generator=_WithoutTitles, ref_template="#/$defs/{model}")
    for entry in (schema, *schema.get("$defs", {}).values()):
        entry.pop("title", None)
        for key, value in entry.get("properties", {}).items():
            entry["properties"][key] = _without_null(value)
    if "children" in schema["properties"]:
        schema["properties"]["children"].update({"$ref": "#/$defs/Actions"})
    return schema


def _without_null(schema: dict[str, Any]) -> dict[str, Any]:
    alternatives = [item for item in schema.get("anyOf", ()) if item != {"type": "null"}]
    if not alternatives:
        return schema
    rest = {key: value for key, value in schema.items() if key not in {"anyOf", "default"}}
    return {**alternatives[0], **rest} if len(alternatives) == 1 else {"anyOf": alternatives, **rest}

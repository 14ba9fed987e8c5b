"""The JSON Schema of launch files in YAML, made of the models: an editor completes and explains what they accept."""

from __future__ import annotations

from typing import Any

from pydantic.json_schema import GenerateJsonSchema

from orchestra.description.actions import ACTIONS, model_of
from orchestra.description.alternatives import told_apart
from orchestra.description.launch import Launch
from orchestra.description.rules import with_hyphens, with_rules
from orchestra.description.twins import twin

_DRAFT = "https://json-schema.org/draft/2020-12/schema"
_ROOT_KEYS: dict[str, dict[str, Any]] = {
    "deprecated": {"type": "string"},
    "children": {"$ref": "#/$defs/Actions"},
}


def launch_schema() -> dict[str, Any]:
    """Return the schema of a YAML launch file."""
    definitions: dict[str, Any] = {}
    actions = {}
    for name in ACTIONS:
        schema = _schema_of(name)
        definitions.update(schema.pop("$defs", {}))
        definitions[name] = _relaxed(name, _shortened(schema))
        actions[name] = {"$ref": f"#/$defs/{name}"}
    for name, definition in definitions.items():
        definitions[name] = with_rules(name, with_hyphens(definition, name))
    definitions["Action"] = with_hyphens(_action(actions), "Action")
    definitions["Actions"] = {"type": "array", "items": {"$ref": "#/$defs/Action"}}
    return {
        "$schema": _DRAFT,
        "title": "Launch file",
        "description": "A ROS 2 launch file in YAML, with Orchestra's extensions.",
        "type": "object",
        "properties": {"launch": _root()},
        "required": ["launch"],
        "additionalProperties": False,
        "$defs": dict(sorted(definitions.items())),
    }


def _root() -> dict[str, Any]:
    """Return the schema of what stands behind `launch`."""
    return {
        "description": "The actions of the file, in order.",
        "type": ["array", "object"],
        "items": {"$ref": "#/$defs/Action"},
        "properties": {
            name: {"description": entry.description, **_ROOT_KEYS[name]}
            for name, entry in Launch.model_fields.items()
        },
        "required": ["children"],
        "additionalProperties": False,
    }


def _action(actions: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of a list item: a mapping with the action's name as its one key."""
    return {
        "description": "An action: its name, and below it its keys.",
        "type": "object",
        "minProperties": 1,
        "maxProperties": 1,
        "properties": actions,
        "additionalProperties": False,
    }


def _shortened(schema: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of an action that may be empty, or a bare list of actions, where it may be."""
    required = schema.get("required", [])
    if not required:
        return {**schema, "type": ["object", "null"]}
    if required == ["children"]:
        return {**schema, "type": ["object", "array"], "items": {"$ref": "#/$defs/Action"}}
    return schema


def _relaxed(name: str, schema: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of an action without the keys that others may stand for: of these a rule tells."""
    model = model_of(name)
    assert model is not None  # noqa: S101 - the name is from the table
    always = model.required_beside(model.known_keys())
    required = [key for key in schema.get("required", ()) if key in always]
    rest = {key: value for key, value in schema.items() if key != "required"}
    return {**rest, "required": required} if required else rest


class _WithoutTitles(GenerateJsonSchema):
    """Leaves out what pydantic makes of the names of fields: it says nothing that the key does not."""

    def field_title_should_be_set(self, schema: Any) -> bool:  # noqa: ANN401 - pydantic's own signature
        del schema
        return False


def _schema_of(name: str) -> dict[str, Any]:
    """Return the schema of an action, keys that may be left out without their null."""
    model = model_of(name)
    assert model is not None  # noqa: S101 - the name is from the table
    schema = twin(model).model_json_schema(schema_generator=_WithoutTitles, ref_template="#/$defs/{model}")
    for entry in (schema, *schema.get("$defs", {}).values()):
        entry.pop("title", None)
        for key, value in entry.get("properties", {}).items():
            entry["properties"][key] = told_apart(_without_null(value))
    if "children" in schema["properties"]:
        schema["properties"]["children"].update({"$ref": "#/$defs/Actions"})
    return schema


def _without_null(schema: dict[str, Any]) -> dict[str, Any]:
    """Return the schema of a key without the null and the default that say that it may be left out."""
    alternatives = [item for item in schema.get("anyOf", ()) if item != {"type": "null"}]
    rest = {key: value for key, value in schema.items() if key not in {"anyOf", "default"}}
    if not alternatives:
        return rest
    return {**alternatives[0], **rest} if len(alternatives) == 1 else {"anyOf": alternatives, **rest}

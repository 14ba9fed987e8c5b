"""What a JSON Schema says of keys beyond their values: other spellings, and which of them cannot stand together.

The models say the latter in code (`Entity.conflict`); a test holds the two to each other.
"""

from __future__ import annotations

from typing import Any, Final

Schema = dict[str, Any]


def _never(key: str, other: str) -> Schema:
    """Return the rule that two keys cannot stand together."""
    return {"if": {"required": [key]}, "then": {"properties": {other: False}}}


def _one_of(*keys: str) -> Schema:
    """Return the rule that at least one of some keys stands there."""
    words = ", ".join(f"`{key}`" for key in keys)
    return {"anyOf": [{"required": [key]} for key in keys], "errorMessage": f"one of {words} is missing"}


def _with(key: str, *others: str) -> Schema:
    """Return the rule that a key goes with at least one of others."""
    return {"if": {"required": [key]}, "then": _one_of(*others)}


# Keys of any entity that has both.
_PAIRS: Final = (
    ("if", "unless"),
    *(("restart", key) for key in ("respawn", "respawn_delay", "respawn_max_retries")),
)
_FACTS: Final = (
    *("log", "message", "topic", "node", "service", "action", "parameter", "lifecycle", "tf", "tcp", "http"),
    *("file", "command", "notify"),
)
_STARTED: Final = [
    _one_of("exec", "module", "script"),
    *(_never(*pair) for pair in (("exec", "module"), ("exec", "script"), ("module", "script"))),
    *(_never(*pair) for pair in (("pkg", "module"), ("pkg", "script"))),
]
_RULES: Final[dict[str, list[Schema]]] = {
    "Alive": [
        _one_of("notify", "message", "command"),
        *(_with(*pair) for pair in (("message", "min_rate"), ("min_rate", "message"), ("window", "message"))),
        *(_with(key, "command") for key in ("interval", "timeout", "failures")),
    ],
    "DependsOn": [
        _one_of("node", "process", "label"),
        *(_never(*pair) for pair in (("node", "process"), ("node", "label"), ("process", "label"))),
    ],
    "Limits": [
        _with("exclusive", "cores"),
        _with("priority", "scheduler"),
        {
            "if": {"required": ["memory_lock"]},
            "then": {"properties": {"rlimits": {"properties": {"memlock": False}}}},
        },
    ],
    **dict.fromkeys(("lifecycle_node", "node"), _STARTED),
    "Param": [
        _one_of("value", "param", "from"),
        *(_never(*pair) for pair in (("value", "param"), ("name", "from"), ("value", "from"))),
        *(_never(*pair) for pair in (("param", "from"), ("type", "param"), ("type", "from"))),
        {"if": {"not": {"required": ["from"]}}, "then": {"required": ["name"]}},
        _with("allow_substs", "from"),
    ],
    "Ready": [_one_of(*_FACTS), _with("interval", "tcp", "http", "file", "command")],
    "set_parameter": [_one_of("value", "param"), _never("value", "param"), _with("type", "value")],
}


def with_rules(name: str, schema: Schema) -> Schema:
    """Return the schema of an entity with what holds between its keys."""
    keys = schema.get("properties", {}).keys()
    pairs = [_never(*pair) for pair in _PAIRS if set(pair) <= keys]
    rules = [*pairs, *_RULES.get(name, ())]
    return {**schema, "allOf": rules} if rules else schema


def with_hyphens(schema: Schema, name: str) -> Schema:
    """Return the schema of an entity with the spelling of its keys that has hyphens: read, but not proposed."""
    spellings = {
        f"^{key.replace('_', '-')}$": {"$ref": f"#/$defs/{name}/properties/{key}"}
        for key in schema.get("properties", {})
        if "_" in key
    }
    return {**schema, "patternProperties": spellings} if spellings else schema

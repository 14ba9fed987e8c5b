"""JSON Schema of parameter files, as rcl reads them.

Two things about these files JSON cannot say, and `orchestra check` can: whether a text is in quotes, so `[1, "2"]` is
refused here but `x: "1"` passes for a number that is meant; and whether a number has a point, so `[1, 2.5]`, which rcl
refuses, passes. Source: `orchestra.resolve.rcl`; what rcl makes of each spelling is measured in
`tests/data/rcl-probes.jsonl`.
"""

from __future__ import annotations

from typing import Any, Final

from orchestra.cli.schemas.records import DIALECT, Schema

_PART: Final = r"(\*\*?|[A-Za-z_][A-Za-z0-9_]*)"
_NODE: Final = rf"^(?!ros__parameters)/?{_PART}(/{_PART})*$"
# Files may be read with `allow_substs`: what their names come to is known then.
_WITH_SUBSTITUTION: Final = r"^(?!ros__parameters$).*\$\("
_NAME: Final = "^."

# What rcl reads as a boolean or a number and YAML 1.2 as a text; and what a launch file may put in its place.
_BOOLEANS: Final = r"^(y|Y|yes|Yes|YES|n|N|no|No|NO|on|On|ON|off|Off|OFF)$|\$\("
_NUMBERS: Final = (
    r"^[-+]?([Ii][Nn][Ff]([Ii][Nn][Ii][Tt][Yy])?|[Nn][Aa][Nn]|\+?\.(inf|Inf|INF)|0[xX][0-9a-fA-F.]+([pP][-+]?[0-9]+)?)$"
    r"|\$\("
)

_PARAMETERS: Final = (
    "Parameters by name. A mapping stands for a group: `a: {b: 1}` is the parameter `a.b`. A value is a boolean, a "
    "whole number, a number with a point, a text, or a list of one of these."
)
_VALUE: Final = (
    "A boolean, a whole number, a number with a point, a text, a list of values of one type, or a group."
)


def parameters_schema() -> Schema:
    """Return the schema of a parameter file."""
    return {
        "$schema": DIALECT,
        "title": "Parameter file",
        "description": "Parameters of ROS 2 nodes: names of nodes, below each `ros__parameters` and its parameters.",
        "type": ["object", "null"],
        "patternProperties": _nodes(),
        "additionalProperties": False,
        "$defs": {
            "List": _list(),
            "Node": _node(),
            "Parameters": _parameters(),
            "Value": _value(),
        },
    }


def _node() -> Schema:
    return {
        "description": (
            "A node by its name or a pattern (`/**` every node, `/*/name` in any namespace of one level, `/**/name` in "
            "any), or a namespace with nodes below it."
        ),
        "type": "object",
        "minProperties": 1,
        "properties": {"ros__parameters": {"$ref": "#/$defs/Parameters"}},
        "patternProperties": _nodes(),
        "additionalProperties": False,
    }


def _nodes() -> Schema:
    return {name: {"$ref": "#/$defs/Node"} for name in (_NODE, _WITH_SUBSTITUTION)}


def _parameters() -> Schema:
    return {
        "description": _PARAMETERS,
        "type": "object",
        "properties": {
            "use_sim_time": {
                "description": "Whether the node goes by `/clock` instead of the machine's time.",
                **_words("boolean", _BOOLEANS),
            }
        },
        "patternProperties": {"^(?!use_sim_time$).": {"$ref": "#/$defs/Value"}},
        "additionalProperties": False,
    }


def _value() -> Schema:
    return {
        "description": _VALUE,
        "type": ["boolean", "integer", "number", "string", "array", "object"],
        "patternProperties": {_NAME: {"$ref": "#/$defs/Value"}},
        "additionalProperties": False,
        "if": {"type": "array"},
        "then": {"$ref": "#/$defs/List"},
    }


def _list() -> Schema:
    """Return the schema of a list: what is in it tells of which type all of it must be."""
    texts = {"items": {"type": "string"}}
    return {
        "description": "Values of one type.",
        "type": "array",
        **_where("boolean", _BOOLEANS, _where("number", _NUMBERS, texts)),
    }


def _where(kind: str, words: str, otherwise: Schema) -> Schema:
    return {"if": {"contains": {"type": kind}}, "then": {"items": _words(kind, words)}, "else": otherwise}


def _words(kind: str, words: str) -> dict[str, Any]:
    return {"type": [kind, "string"], "pattern": words, "patternErrorMessage": f"expected a {kind}"}

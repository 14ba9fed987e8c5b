"""What launch files import as `launch.frontend`: the language of XML and YAML files, and how to add to it.

entity.py              an element or mapping of a file
parser.py              from entities to actions
parse_substitution.py  from texts to substitutions
expose.py              actions and substitutions of third parties
tags.py                which action a tag stands for, and what reads it
calls.py               which substitution a name stands for
reading/               what each action takes from its entity
"""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "Entity": "entity",
    "InvalidFrontendLaunchFileError": "invalid_frontend_launch_file_error",
    "Parser": "parser",
    "entity": "",
    "expose": "",
    "expose_action": "expose",
    "expose_substitution": "expose",
    "parse_substitution": "",
    "parser": "",
    "type_utils": "",
}

__all__ = [
    "Entity",
    "InvalidFrontendLaunchFileError",
    "Parser",
    "expose_action",
    "expose_substitution",
    "type_utils",
]

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)

"""Classes of services and actions by their names; those of messages are in `orchestra.ros.interfaces`."""

from __future__ import annotations

import importlib
from typing import Any

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.ros.interfaces.finding import make_importable
from orchestra.ros.interfaces.names import UnknownMessageTypeError, message_type
from orchestra.ros.interfaces.reading.mistakes import DefinitionError

# What a class of this kind has, and no other.
_PARTS = {"srv": "Request", "action": "Goal"}
_WORDS = {"srv": "service", "action": "action", "msg": "message"}


def interface_type(name: str) -> Any:  # noqa: ANN401 - a class of an untyped package
    """Return the class for `package/msg/Name`, `package/srv/Name` or `package/action/Name`. Raises `RunError`."""
    match name.split("/"):
        case [_, "srv" | "action" as kind, _]:
            return _of_kind(kind, name)
    return message_class(name)


def message_class(name: str) -> Any:  # noqa: ANN401 - as above
    """Return the class of a message; `package/Name` will do. Raises `RunError`."""
    try:
        return message_type(name)
    except UnknownMessageTypeError as error:
        raise RunError(str(error)) from None


def service_class(name: str) -> Any:  # noqa: ANN401 - as above
    """Return the class of a service; `package/Name` will do. Raises `RunError`."""
    return _of_kind("srv", name)


def action_class(name: str) -> Any:  # noqa: ANN401 - as above
    """Return the class of an action; `package/Name` will do. Raises `RunError`."""
    return _of_kind("action", name)


def _of_kind(kind: str, name: str) -> Any:  # noqa: ANN401 - as above
    parts = name.split("/")
    if len(parts) == 2:  # noqa: PLR2004 - package and name
        parts.insert(1, kind)
    word = _WORDS[kind]
    if len(parts) != 3 or parts[1] != kind or not all(part.isidentifier() for part in parts):  # noqa: PLR2004
        raise RunError(f"'{name}' is not the name of a type of {word}: expected package/{kind}/Name")
    package, _, local = parts
    make_importable(package)
    try:
        module = importlib.import_module(f"{package}.{kind}")
    except ModuleNotFoundError as error:
        if error.name not in (package, f"{package}.{kind}"):
            raise
        raise RunError(f"{name}: package {package} is not installed or has no {word}s") from None
    try:
        found = getattr(module, local, None)
    except DefinitionError as error:
        raise RunError(str(error)) from error
    if not hasattr(found, _PARTS[kind]):
        known = getattr(module, "__all__", None) or [
            key for key, value in vars(module).items() if hasattr(value, _PARTS[kind])
        ]
        near = nearest(local, known)
        raise RunError(
            f"{name}: package {package} has no {word} {local}" + (f"; did you mean {near}?" if near else "")
        )
    return found

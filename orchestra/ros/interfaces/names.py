"""From the name of a message type to its class."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import UsageError
from orchestra.nearest import nearest
from orchestra.ros.interfaces.finding import known, make_importable
from orchestra.ros.interfaces.reading.mistakes import DefinitionError
from orchestra.ros.interfaces.tf_package import MESSAGE, PACKAGE, tf_message_type

if TYPE_CHECKING:
    from types import ModuleType

    from orchestra.ros.interfaces.tf_package import MessageClass


class UnknownMessageTypeError(UsageError):
    """A name stands for no message type that is here."""


def message_type(name: str) -> MessageClass:
    """Return the class for `package/msg/Name`; `package/Name` means the same.

    Raises:
        UnknownMessageTypeError: not such a name, or its package or the type in it is not here.
    """
    package, message = _split(name)
    if (package, message) == (PACKAGE, MESSAGE):
        return tf_message_type()
    make_importable(package)
    module = _messages_of(package, name)
    try:
        found = getattr(module, message, None)
    except DefinitionError as error:
        raise UnknownMessageTypeError(str(error)) from error
    if not _is_message(found):
        known = getattr(module, "__all__", None) or [
            word for word, value in vars(module).items() if _is_message(value)
        ]
        raise UnknownMessageTypeError(
            f"{name}: package {package} has no message {message}{_hint(message, known)}"
        )
    return found


def _split(name: str) -> tuple[str, str]:
    match name.split("/"):
        case [package, message] | [package, "msg", message] if (
            package.isidentifier() and message.isidentifier()
        ):
            return package, message
        case [_, "srv" | "action" as kind, _]:
            raise UnknownMessageTypeError(f"{name} is not a message type (it names a type of kind {kind})")
    raise UnknownMessageTypeError(f"{name!r} is not the name of a message type: expected package/msg/Name")


def _messages_of(package: str, name: str) -> ModuleType:
    try:
        return importlib.import_module(f"{package}.msg")
    except ModuleNotFoundError as error:
        if error.name not in (package, f"{package}.msg"):
            raise
    raise UnknownMessageTypeError(
        f"{name}: package {package} is not installed or has no messages{_hint(package, _installed())}"
    )


def _is_message(value: object) -> bool:
    return isinstance(value, type) and hasattr(type(value), "_TYPE_SUPPORT")


def _installed() -> list[str]:
    folders = [Path(entry) for entry in sys.path]
    return [*known(), *(found.parts[-3] for folder in folders for found in folder.glob("*/msg/__init__.py"))]


def _hint(word: str, candidates: list[str]) -> str:
    near = nearest(word, candidates)
    return f"; did you mean {near}?" if near else ""

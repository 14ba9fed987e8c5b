"""From the name of a message type to its class."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

from orchestra.errors import UsageError
from orchestra.nearest import nearest

# A class of a package without type information.
MessageClass = Any

_TF_PACKAGE = "tf2_msgs"
_TF_MESSAGE = "TFMessage"


class UnknownMessageTypeError(UsageError):
    """A name stands for no message type that is here."""


def tf_message_type() -> MessageClass:
    """Return the class of `tf2_msgs/msg/TFMessage`: of the installed package, else one that needs no package.

    Both have the same name, fields, wire format and type hash in the graph.
    """
    try:
        return importlib.import_module(f"{_TF_PACKAGE}.msg").TFMessage
    except ModuleNotFoundError as error:
        if error.name not in (_TF_PACKAGE, f"{_TF_PACKAGE}.msg"):
            raise
    # Only now: it brings geometry_msgs and the C structures, which an installed package makes needless.
    return importlib.import_module("orchestra.ros.interfaces.tf2").TFMessage


def message_type(name: str) -> MessageClass:
    """Return the class for `package/msg/Name`; `package/Name` means the same.

    Raises:
        UnknownMessageTypeError: not such a name, or its package or the type in it is not here.
    """
    package, message = _split(name)
    if (package, message) == (_TF_PACKAGE, _TF_MESSAGE):
        return tf_message_type()
    module = _messages_of(package, name)
    found = getattr(module, message, None)
    if not _is_message(found):
        known = [word for word, value in vars(module).items() if _is_message(value)]
        raise UnknownMessageTypeError(
            f"{name}: package {package} has no message {message}{_hint(message, known)}"
        )
    return found


def install() -> bool:
    """Make `import tf2_msgs.msg` work in this process; returns whether that was needed.

    Only TFMessage is in the module, none of the other types of tf2_msgs.
    """
    found = tf_message_type()
    if _TF_PACKAGE in sys.modules:
        return False
    package, messages = ModuleType(_TF_PACKAGE), ModuleType(f"{_TF_PACKAGE}.msg")
    package.__path__ = []
    vars(package)["msg"] = messages
    vars(messages)[_TF_MESSAGE] = found
    sys.modules |= {package.__name__: package, messages.__name__: messages, found.__module__: messages}
    return True


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
    if package == _TF_PACKAGE:
        raise UnknownMessageTypeError(
            f"{name}: package tf2_msgs is not installed; without it, only TFMessage is here"
        )
    raise UnknownMessageTypeError(
        f"{name}: package {package} is not installed or has no messages{_hint(package, _installed())}"
    )


def _is_message(value: object) -> bool:
    return isinstance(value, type) and hasattr(type(value), "_TYPE_SUPPORT")


def _installed() -> list[str]:
    folders = [Path(entry) for entry in sys.path]
    return [found.parts[-3] for folder in folders for found in folder.glob("*/msg/__init__.py")]


def _hint(word: str, candidates: list[str]) -> str:
    near = nearest(word, candidates)
    return f"; did you mean {near}?" if near else ""

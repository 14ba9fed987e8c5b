"""What launch files import is the same for each of them, whatever one has done to its classes and modules.

The classes are as they are when they are handed out for the first time in this process.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from types import ModuleType

_ROOM = __name__.rpartition(".")[0] + "."
_classes: dict[type[Any], dict[str, Any]] = {}
_modules: dict[ModuleType, dict[str, Any]] = {}


def keep_module(module: ModuleType) -> None:
    """Remember a module, and the classes in it."""
    if module not in _modules:
        _modules[module] = {name: value for name, value in vars(module).items() if not _is_private(name)}
        for name, value in list(_modules[module].items()):
            keep(value, module, name)


def keep(value: Any, module: ModuleType, name: str) -> None:
    """Remember what a module has under a name; a class of ours with those that it is derived from."""
    if module in _modules:
        _modules[module][name] = value
    if isinstance(value, type):
        for kind in value.__mro__:
            if kind not in _classes and kind.__module__.startswith(_ROOM):
                _classes[kind] = dict(vars(kind))


def restore() -> None:
    """Make all that is remembered what it was."""
    for kind, content in _classes.items():
        if vars(kind) != content:
            _restore_class(kind, content)
    for module, content in _modules.items():
        for name, value in content.items():
            if vars(module).get(name) is not value:
                setattr(module, name, value)


def _restore_class(kind: type[Any], content: dict[str, Any]) -> None:
    for name in [name for name in vars(kind) if name not in content]:
        delattr(kind, name)
    for name, value in content.items():
        if vars(kind).get(name) is not value:
            setattr(kind, name, value)


def _is_private(name: str) -> bool:
    return name.startswith("__")

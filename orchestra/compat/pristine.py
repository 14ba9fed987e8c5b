"""What launch files import is the same for each of them, whatever one has done to its classes and modules.

The classes are as they are when they are handed out for the first time in this process.
"""

from __future__ import annotations

from operator import is_
from types import ModuleType
from typing import Any

_ROOM = __name__.rpartition(".")[0] + "."
_classes: dict[type[Any], dict[str, Any]] = {}
_modules: dict[ModuleType, dict[str, Any]] = {}
_sizes: dict[ModuleType, int] = {}  # of modules in which nothing is new


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
        table = vars(module)
        if not all(map(is_, map(table.get, content), content.values())):
            for name, value in content.items():
                if table.get(name) is not value:
                    setattr(module, name, value)
        if len(table) != _sizes.get(module):
            _drop_new(module, content)


def _drop_new(module: ModuleType, content: dict[str, Any]) -> None:
    """Remove what code has put into a module, but for modules, which the import system puts there."""
    table = vars(module)
    for name in [name for name in table if name not in content and not _is_private(name)]:
        if not isinstance(table[name], ModuleType):
            delattr(module, name)
    _sizes[module] = len(table)


def _restore_class(kind: type[Any], content: dict[str, Any]) -> None:
    for name in [name for name in vars(kind) if name not in content]:
        delattr(kind, name)
    for name, value in content.items():
        if vars(kind).get(name) is not value:
            setattr(kind, name, value)


def _is_private(name: str) -> bool:
    return name.startswith("__")

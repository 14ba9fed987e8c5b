"""Imports that are put off until somebody uses the module: most commands end before (0.1 s of CPU)."""

from __future__ import annotations

import sys
from importlib.util import find_spec, module_from_spec
from types import ModuleType
from typing import Any, Final

# What rclpy and the messages of its own services import, and use for arrays of a fixed length and parameter files.
_SELDOM: Final = ("numpy", "yaml")
# The package of which messages need one small function would import a compiler of templates beside it, and goes on
# without where that is not to be had.
_NEVER: Final = "rosidl_generator_py.generate_py_impl"
_SPEC: Final = "__spec__"
# What the import system asks of a package when it imports something in it.
_OF_THE_IMPORT_SYSTEM: Final = (_SPEC, "__path__")


class _Postponed(ModuleType):
    """A module that is executed when somebody asks for what is in it.

    That of `importlib.util.LazyLoader` is executed by `import NAME` already, which looks at the specification.
    """

    def __getattribute__(self, name: str) -> Any:  # noqa: ANN401 - whatever the module has
        get = super().__getattribute__
        if name in _OF_THE_IMPORT_SYSTEM:
            return get(name)
        spec = get(_SPEC)
        self.__class__ = ModuleType  # type: ignore[assignment]  # it is one from here on
        spec.loader.exec_module(self)
        return getattr(self, name)


def postpone() -> None:
    """Have these modules imported when they are used. For a process with one thread of Python."""
    sys.modules.setdefault(_NEVER, None)  # type: ignore[arg-type]  # as the import system has it
    for name in _SELDOM:
        postpone_module(name)


def postpone_module(name: str) -> None:
    """Have a module imported when it is used, unless it is there. What is in a package can be imported before it."""
    spec = None if name in sys.modules else find_spec(name)
    if spec is not None and spec.loader is not None:
        module = sys.modules[name] = module_from_spec(spec)
        module.__class__ = _Postponed

"""Serves the packages of this room under the names that launch files import, for as long as launch files are loaded.

Rejected: installing a top-level package called `launch`, which would hide or be hidden by the real one; loading our
files under those names, which would make every class exist twice.
"""

from __future__ import annotations

import importlib
import os
import sys
from contextlib import contextmanager
from importlib.machinery import ModuleSpec, PathFinder, SourceFileLoader
from importlib.util import find_spec
from itertools import filterfalse
from types import ModuleType
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.place import is_own
from orchestra.witness.observing import observer
from orchestra.witness.origins import INSTALLED, PYTHON

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence
    from importlib.abc import Loader, MetaPathFinder
    from types import CodeType
else:  # nobody asks for what they add, and they import some thirty modules
    Loader = MetaPathFinder = object

_INSTALLED: Final = (*PYTHON, *INSTALLED)
_FOLDER: Final = __file__.rpartition("/")[0]
SERVED: Final = frozenset(entry.name for entry in os.scandir(_FOLDER) if entry.is_dir())
_ROOM: Final = __name__.rpartition(".")[0]
_OURS: Final = f"{__name__.partition('.')[0]}."
_served: dict[str, ModuleType] = {}  # by the names under which they have been imported in this process


class _Alias(Loader):
    """Gives a module that exists under another name."""

    def __init__(self, name: str) -> None:
        self._name = name
        self._spec: ModuleSpec | None = None

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        # Here, because only launch files in Python need them.
        from orchestra.compat import pristine  # noqa: PLC0415
        from orchestra.compat.borrowed import borrowing  # noqa: PLC0415

        module = importlib.import_module(self._name)
        if not hasattr(module, "__path__"):
            vars(module).setdefault("__getattr__", borrowing(self._name))
        self._spec = module.__spec__
        pristine.keep_module(module)
        _served[spec.name] = module
        return module

    def exec_module(self, module: ModuleType) -> None:
        """Undo what the import system has written on the module: it stays what it is."""
        module.__spec__ = self._spec
        module.__loader__ = self._spec.loader if self._spec is not None else None


class _Finder(MetaPathFinder):
    """Finds what is served before anybody else does, an installed package of the same name included."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None = None,  # noqa: ARG002 - the protocol
        target: ModuleType | None = None,  # noqa: ARG002 - the protocol
    ) -> ModuleSpec | None:
        if fullname.partition(".")[0] not in SERVED:
            return None
        name = f"{_ROOM}.{fullname}"
        found = find_spec(name)
        if found is None:
            return None
        return ModuleSpec(fullname, _Alias(name), is_package=found.submodule_search_locations is not None)


class _Asked(MetaPathFinder):
    """Finds nothing: it is asked last, and keeps what nobody has."""

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None = None,  # noqa: ARG002 - the protocol
        target: ModuleType | None = None,  # noqa: ARG002 - the protocol
    ) -> ModuleSpec | None:
        from orchestra.compat.asked import keep_module  # noqa: PLC0415 - few modules are not there

        keep_module(fullname)
        return None


class _Compiling(MetaPathFinder):
    """Finds modules of ours that nobody has compiled yet, and lets what they are compiled to be kept beside them.

    That of users' modules is not: nobody expects it there, and many may not write. But a start imports 150 of ours for
    launch files in Python, and compiles them in 90 ms where they are as they were written, as in a working copy.
    """

    def find_spec(
        self,
        fullname: str,
        path: Sequence[str] | None = None,
        target: ModuleType | None = None,
    ) -> ModuleSpec | None:
        spec = PathFinder.find_spec(fullname, path, target) if fullname.startswith(_OURS) else None
        if spec is not None and type(spec.loader) is SourceFileLoader:
            spec.loader = _Keeping(fullname, spec.loader.path)
        return spec


class _Keeping(SourceFileLoader):
    """Keeps the code that it compiles, as is done where nothing is served."""

    def get_code(self, fullname: str) -> CodeType | None:
        """Return the code of a module."""
        before, sys.dont_write_bytecode = sys.dont_write_bytecode, False
        try:
            return super().get_code(fullname)
        finally:
            sys.dont_write_bytecode = before


class Serving:
    """The modules that are there while the names are served."""

    def __init__(self, before: dict[str, ModuleType]) -> None:
        self._known = before

    def renew(self) -> None:
        """Make the modules what they were before code of launch files has run, and go on."""
        sys.dont_write_bytecode = True
        modules, known = sys.modules, self._known
        modules.update(known)
        if len(modules) != len(known):
            for name, module in _added(known).items():
                if _served.get(name) is module or not _goes(name, module):
                    known[name] = module
            for name in _added(known):
                del modules[name]
        _restore()


@contextmanager
def served(untouched: Callable[[], bool] = lambda: False) -> Iterator[Serving]:
    """Serve the names for a while; afterwards the modules of this process are as they were.

    What launch files have imported is forgotten where it is the users' own: the next one begins anew. `untouched` tells
    whether no code of theirs has run.
    """
    finder, compiling, asked = _Finder(), _Compiling(), _Asked()
    before = dict(sys.modules)
    bytecode, sys.dont_write_bytecode = sys.dont_write_bytecode, True
    if any(map(before.__contains__, SERVED)):
        for name in [name for name in before if name.partition(".")[0] in SERVED]:
            del sys.modules[name]
    sys.meta_path.insert(0, finder)
    sys.meta_path.append(asked)
    if not bytecode and PathFinder in sys.meta_path:
        sys.meta_path.insert(sys.meta_path.index(PathFinder), compiling)
    watching = observer()
    watching.ours |= SERVED
    if watching.installed:  # many files import the same, and nobody looks whether they are there before
        sys.modules.update(_served)
    try:
        yield Serving(dict(sys.modules))
    finally:
        sys.meta_path.remove(finder)
        if asked in sys.meta_path:
            sys.meta_path.remove(asked)
        if compiling in sys.meta_path:
            sys.meta_path.remove(compiling)
        sys.dont_write_bytecode = bytecode
        _forget_new(before)
        if not untouched():
            _restore()


def _restore() -> None:
    """Make what launch files have imported what it was, where one has imported anything."""
    module = sys.modules.get(f"{_ROOM}.pristine")
    if module is not None:
        module.restore()


def _forget_new(before: dict[str, ModuleType]) -> None:
    """Make the modules of this process what they were, but for installed ones that have been added."""
    # All are judged before the first goes: where a package without a file is, it learns from the one around it.
    for name in [name for name, module in _added(before).items() if _goes(name, module)]:
        del sys.modules[name]
    sys.modules.update(before)


def _added(before: dict[str, ModuleType]) -> dict[str, Any]:
    """Return the modules that have been added."""
    return {name: sys.modules[name] for name in filterfalse(before.__contains__, list(sys.modules))}


def _goes(name: str, module: object) -> bool:
    """Return whether a module that has been added is to be forgotten."""
    return name.partition(".")[0] in SERVED or _is_of_users(name, module)


def _is_of_users(name: str, module: object) -> bool:
    """Return whether a module is neither part of Python, nor installed for it, nor ours.

    One that is in no file is its package's; without a package it is the users' unless Python has it built in.
    """
    if not isinstance(module, ModuleType):
        return True  # something that code has put in its place
    try:
        file = getattr(module, "__file__", None) or next(iter(getattr(module, "__path__", ())), None)
    except KeyError:  # a package without a file asks the one around it, which code has taken away
        return True
    if file is not None:
        return not is_own(file) and not os.path.realpath(file).startswith(_INSTALLED)
    package, _, inner = name.partition(".")
    return not inner and package not in sys.builtin_module_names

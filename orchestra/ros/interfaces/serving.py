"""The modules of a package of definitions, as rosidl lays them out: `package`, `package.msg`, `package.msg._name`."""

from __future__ import annotations

import importlib
import re
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from importlib.abc import Loader
    from importlib.machinery import ModuleSpec
    from pathlib import Path
    from types import ModuleType
else:
    Loader = object  # its module brings ten others, and nothing that is needed here

# What of a definition can be imported from the module of its kind, by the ending behind its name.
_ENDINGS = {
    "msg": ("",),
    "srv": ("", "_Request", "_Response", "_Event"),
    "action": (
        "",
        *(
            f"_{service}_{part}"
            for service in ("GetResult", "SendGoal")
            for part in ("Event", "Request", "Response")
        ),
    ),
}


# Written by hand: with a transform a line, the general way takes half as long again.
_QUICKER = {"tf2_msgs.msg._tf_message": "orchestra.ros.interfaces.tf2"}


class Kind(NamedTuple):
    """The definitions of a package that are of one kind: `msg`, `srv` or `action`."""

    package: str
    folder: Path
    kind: str

    def files(self) -> list[Path]:
        """Return the definition files; of two with one name, the one that is not IDL."""
        found = {path.stem: path for path in sorted((self.folder / self.kind).glob("*.idl"))}
        found |= {path.stem: path for path in sorted((self.folder / self.kind).glob(f"*.{self.kind}"))}
        return [found[stem] for stem in sorted(found)]

    def file_of_module(self, module: str) -> Path | None:
        """Return the file whose types a module has."""
        return next((path for path in self.files() if module_of(path.stem) == module), None)

    def names(self) -> dict[str, Path]:
        """Return the names that can be imported, with the files that define them."""
        return {path.stem + ending: path for path in self.files() for ending in _ENDINGS[self.kind]}


def module_of(name: str) -> str:
    """Return the name of the module of a type, as rosidl has it: `_tf_message` of `TFMessage`."""
    apart = re.sub("([a-z0-9])([A-Z])", r"\1_\2", re.sub("(.)([A-Z][a-z]+)", r"\1_\2", name))
    return f"_{apart.lower()}"


class _Loader(Loader):
    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """Leave the making of the module to the interpreter."""
        del spec
        return None


class DefinedPackage(_Loader):
    """The package: it has a module for each kind, which is imported when it is asked for."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def exec_module(self, module: ModuleType) -> None:
        """Fill the package."""
        module.__path__ = []
        module.__file__ = str(self._folder)


class FilesOfKind(_Loader):
    """The module of a kind: it has the types, which are made when they are asked for."""

    def __init__(self, kind: Kind) -> None:
        self._kind = kind

    def exec_module(self, module: ModuleType) -> None:
        """Fill the module."""
        files = self._kind.names()
        module.__path__ = []
        vars(module)["__all__"] = sorted(files)

        def __getattr__(name: str) -> Any:  # noqa: ANN401, N807 - the function of a module; a class
            if name not in files:
                raise AttributeError(f"module {module.__name__!r} has no attribute {name!r}")
            of_file = importlib.import_module(f"{module.__name__}.{module_of(files[name].stem)}")
            value = getattr(of_file, name)
            setattr(module, name, value)
            return value

        def __dir__() -> list[str]:  # noqa: N807 - as above
            return sorted({*vars(module), *files})

        vars(module).update(__getattr__=__getattr__, __dir__=__dir__)


class TypesOfFile(_Loader):
    """The module of a definition: its classes."""

    def __init__(self, kind: Kind, file: Path) -> None:
        self._kind = kind
        self._file = file

    def exec_module(self, module: ModuleType) -> None:
        """Read the definition and make its classes."""
        # Only now: a process that uses none of the types reads none.
        from orchestra.ros.interfaces.made.classes import classes_of  # noqa: PLC0415
        from orchestra.ros.interfaces.reading import interface  # noqa: PLC0415

        if module.__name__ in _QUICKER:
            quicker = importlib.import_module(_QUICKER[module.__name__])
            classes = {self._file.stem: getattr(quicker, self._file.stem)}
        else:
            classes = classes_of(interface.read(self._kind.package, self._file), module.__name__)
        vars(module).update(classes)
        # Programs of rosidl look for the metaclasses of a module under their names.
        vars(module).update({type(kind).__name__: type(kind) for kind in classes.values()})

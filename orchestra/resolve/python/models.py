"""Classes that a description names and that code of the user defines."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from functools import reduce
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from pkgutil import iter_modules
from typing import TYPE_CHECKING, Any

from orchestra.compat.seam import connection, is_connected
from orchestra.errors import Code
from orchestra.nearest import is_slip, nearest
from orchestra.resolve.paths import folder_of
from orchestra.resolve.python.calling import user_code

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.text import Template
    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution


def named_class(module: str, name: str, value: Value, written: Template, run: Resolution) -> Any:
    """Return the object `name` of a module, which is imported; None where there is none (which has been reported).

    Modules beside the launch file are found too, after all others, and forgotten again, since those beside other launch
    files may be called the same. What the module does while it is imported is undone as what launch files in Python do.
    """
    if is_connected():
        connection().prepare()
    found: list[Any] = []
    with _path_with(str(folder_of(run.context.file))):
        if not _is_there(module):
            near = _near_module(module)
            replaceable = near is not None and written.constant is not None
            meant = f"{near}{value.text.removeprefix(module)}" if replaceable else None
            _refuse(f"there is no Python module '{module}'", meant, value, run)
            return None
        with user_code(run, value.location.span):
            found.append(import_module(module))
    if not found:
        return None  # what it raised has been reported
    try:
        return reduce(getattr, name.split("."), found[0])
    except AttributeError:
        classes = [key for key, item in vars(found[0]).items() if isinstance(item, type)]
        near = nearest(name, classes)
        replaceable = near is not None and written.constant is not None
        meant = value.text.removesuffix(name) + near if near is not None and replaceable else None
        _refuse(f"the module '{module}' has no class '{name}'", meant, value, run)
        return None


@contextmanager
def _path_with(folder: str) -> Iterator[None]:
    before = set(sys.modules)
    sys.path.append(folder)
    try:
        yield
    finally:
        for name in set(sys.modules) - before:
            file = getattr(sys.modules[name], "__file__", None)
            if file is not None and Path(file).is_relative_to(folder):
                del sys.modules[name]
        if folder in sys.path:  # the code that was imported may have taken it away
            sys.path.reverse()
            sys.path.remove(folder)
            sys.path.reverse()


def _is_there(module: str) -> bool:
    """Return whether there is such a module. Its packages are imported for that, which user code may be."""
    outermost = module.partition(".")[0]
    if find_spec(outermost) is None:
        return False
    try:
        return find_spec(module) is not None
    except ImportError:
        return False
    except Exception:  # noqa: BLE001 - a package of the user's that raises: its import does so again, and is reported
        return True


def _near_module(module: str) -> str | None:
    """Return the module that a name is a slip for, in the first part of it that is not there."""
    above = ""
    for part in module.split("."):
        if _is_there(above + part):
            above += f"{part}."
            continue
        spec = find_spec(above.rstrip(".")) if above else None
        folders = None if spec is None else spec.submodule_search_locations
        names = [item.name for item in iter_modules(folders)] if folders or not above else []
        near = nearest(part, names)
        if near is None or not is_slip(part, near):
            return None
        found = above + near + module[len(above) + len(part) :]
        return found if _is_there(found) else None
    return None


def _refuse(told: str, meant: str | None, value: Value, run: Resolution) -> None:
    run.problems.error(Code.BROKEN_DECLARATION, told, value.location, suggestion=meant)

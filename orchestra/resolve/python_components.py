"""Components as a launch file names them: what can be told of one without importing anything."""

from __future__ import annotations

import ast
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.errors import HERE, Code, Severity
from orchestra.nearest import is_slip, nearest
from orchestra.resolve.containers import known_components
from orchestra.resolve.packages.components import is_named_by_module, registered_by, target_of
from orchestra.resolve.packages.modules import Unrunnable, source_of, unimportable
from orchestra.resolve.python_programs import PATHS
from orchestra.resolve.refusals import refuse, refuse_value
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.text import Template
    from orchestra.resolve.context import Poison, Value
    from orchestra.resolve.resolution import Resolution

# Names that a module has for itself.
_OWN_WAY: Final = frozenset({"__getattr__", "*"})


def check_plugin(package: str, plugin: Value, pkg: Template, run: Resolution) -> Value | Poison:
    """Return a plugin; one that must be in Python and is not here is reported, and one that its package has not.

    Where nothing is started another environment may have what is in Python: then it is no error, unless its name is a
    slip. `pkg` is the package as it is written.
    """
    fault = _fault(package, plugin.text, run)
    if fault is None:
        return _check_registered(package, plugin, pkg, run)
    slip = fault.meant is not None and is_slip(_top(plugin.text), _top(fault.meant))
    weight = run.inputs.weights.package
    if fault.certain or weight is Severity.ERROR or slip:
        return refuse_value(plugin, run.problems, Code.MISSING_EXECUTABLE, fault.told, meant=fault.meant)
    run.problems.weighed(weight, Code.MISSING_EXECUTABLE, f"{fault.told} {HERE}", plugin.location)
    return plugin


def _fault(package: str, plugin: str, run: Resolution) -> Unrunnable | None:
    known = known_components(run)
    if target_of(package, plugin, known) is None:
        # The part that all of a package have in common says nothing of what was meant.
        own = {point.name.rpartition("::")[2]: point.name for point in known if package in point.owners}
        name = plugin.rpartition("::")[2]
        meant = nearest(name, own)
        whole = (
            own[meant] if meant is not None and is_slip(name, meant) else _registered(package, plugin, run)
        )
        return (
            None if whole is None else Unrunnable(f"package {package!r} has no component {plugin!r}", whole)
        )
    if not is_named_by_module(plugin) or not run.scope.changes.keys().isdisjoint(PATHS):
        return None
    folder = str(Path.cwd())
    fault = once(("component", plugin, folder, *sys.path), lambda: _fault_in(plugin, folder))
    meant = None if fault is None else _registered(package, plugin, run)
    return fault if meant is None else Unrunnable(f"package {package!r} has no component {plugin!r}", meant)


def _registered(package: str, plugin: str, run: Resolution) -> str | None:
    """Return the component in C++ of a package that a name is a slip for, None where it has one of that name."""
    names = _components_of(package, run)
    meant = None if plugin in names else nearest(plugin, names)
    return meant if meant is not None and is_slip(plugin, meant) else None


def _components_of(package: str, run: Resolution) -> tuple[str, ...]:
    """Return the names of the components in C++ that a package registers; none where it is not here."""
    prefix = run.context.packages.prefix(package)
    if prefix is None:
        return ()
    key = ("registered", package, str(prefix))
    if key not in run.components:
        run.components[key] = tuple(once(key, lambda: registered_by(package, Path(prefix))))
    return run.components[key]


def _check_registered(package: str, plugin: Value, pkg: Template, run: Resolution) -> Value | Poison:
    """Return a plugin in C++; one that another package registers, and not the one that is named, is reported."""
    name = plugin.text
    owner = name.partition("::")[0]
    if owner == package or target_of(package, name, known_components(run)) is not None:
        return plugin
    if name in _components_of(package, run) or name not in _components_of(owner, run):
        return plugin
    told = f"package {package!r} has no component {name!r}: {owner!r} has it"
    return refuse(pkg, run.context, Code.MISSING_EXECUTABLE, told, meant=owner)


def _fault_in(plugin: str, folder: str) -> Unrunnable | None:
    """Return why nothing is called so in a module."""
    module, _, name = plugin.partition(":")
    fault = unimportable(module, folder)
    if fault is not None:
        return fault if fault.meant is None else fault._replace(meant=f"{fault.meant}:{name}")
    first, _, rest = name.partition(".")
    names = _names_in(source_of(module, folder))
    if names is None or first in names:
        return None
    meant = nearest(first, names)
    whole = None if meant is None else f"{module}:{meant}{rest and '.'}{rest}"
    return Unrunnable(f"module {module!r} has no {first!r}", whole)


def _top(plugin: str) -> str:
    """Return the package or module at the top of a name."""
    return plugin.partition(":")[0].partition(".")[0]


def _names_in(source: Path | None) -> set[str] | None:
    """Return the names that a module gives to something, None where nobody can tell without running it."""
    if source is None:
        return None
    try:
        tree = ast.parse(source.read_bytes())
    except (OSError, SyntaxError, ValueError):
        return None
    names = set(_bound(tree))
    return None if names & _OWN_WAY or _writes_globals(tree) else names


def _bound(tree: ast.Module) -> Iterator[str]:
    """Yield the names that are bound at the top of a module, in branches and loops too, and inside of functions."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            yield node.name
        elif isinstance(node, ast.Import | ast.ImportFrom):
            yield from ((alias.asname or alias.name).partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            yield node.id


def _writes_globals(tree: ast.Module) -> bool:
    return any(
        isinstance(node, ast.Name) and node.id in ("globals", "setattr", "exec") for node in ast.walk(tree)
    )

"""The shape of the code: imports point one way, nothing runs in circles, and modules and functions stay small."""

from __future__ import annotations

import ast
import sys
from dataclasses import dataclass
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Iterator

_ROOT = Path(__file__).parents[1]
_LONGEST_MODULE = 300
_LONGEST_FUNCTION = 50

# Each row may import from its own rooms and from the rows above it: the order of docs/design.md.
_ROWS = (
    (
        "fields",
        "dataclass",
        "errors",
        "location",
        "events",
        "nearest",
        "values",
        "wheels",
        "compiled",
        "patterns",
        "stack",
    ),
    ("settings", "witness"),
    ("pyyaml",),
    ("description",),
    ("compat",),
    ("load",),
    ("resolve",),
    ("declared",),
    ("plan",),
    ("supervise", "logs", "probes"),
    ("control",),
    ("formatting", "convert"),
    ("pipeline",),
    ("cli", "tui", "testing"),
    ("__main__",),
)
_LEVELS = {room: level for level, row in enumerate(_ROWS) for room in row}
_CLIENTS = {"cli", "tui", "testing"}  # they share a row, but know nothing of each other
_SMALL_CORE = {
    *("orchestra.errors", "orchestra.location", "orchestra.events", "orchestra.nearest", "orchestra.values"),
    *("orchestra.dataclass", "orchestra.fields", "orchestra.wheels", "orchestra.patterns", "orchestra.stack"),
    *(
        "orchestra.plan.model",
        "orchestra.plan.conditions",
        "orchestra.plan.reactions",
        "orchestra.plan.codec",
        "orchestra.plan.json_text",
        "orchestra.plan.parameter_file",
        "orchestra.plan.startup",
    ),
}
_SMALL_ROOMS = {"supervise", "logs", "probes"}


@dataclass(frozen=True)
class _Import:
    importer: str
    imported: str
    line: int
    names: tuple[str, ...] = ()

    def __str__(self) -> str:
        return f"{self.importer}:{self.line} imports {self.imported}"


def _files() -> list[Path]:
    return sorted([*_ROOT.glob("orchestra/**/*.py"), *_ROOT.glob("bringup/**/*.py")])


def _module(path: Path) -> str:
    parts = path.relative_to(_ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def _modules() -> dict[str, Path]:
    return {_module(path): path for path in _files()}


def _room(module: str) -> str:
    """Return the room of a module of ours, an empty text for any other."""
    return module.split(".")[1] if module.startswith("orchestra.") else ""


@cache
def _imports() -> tuple[_Import, ...]:
    return tuple(found for module, path in _modules().items() for found in _imports_of(module, path))


def _imports_of(module: str, path: Path) -> Iterator[_Import]:
    """Yield every import of a module, inside functions and `if TYPE_CHECKING` too."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield _Import(module, alias.name, node.lineno)
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{module}:{node.lineno}: a relative import"
            assert node.module is not None
            yield from _imports_from(module, node, node.module)


def _imports_from(module: str, node: ast.ImportFrom, source: str) -> Iterator[_Import]:
    """Yield the modules behind `from source import names`: a name may itself be a module."""
    names = [alias.name for alias in node.names]
    submodules = [f"{source}.{name}" for name in names if f"{source}.{name}" in _modules()]
    for submodule in submodules:
        yield _Import(module, submodule, node.lineno)
    if len(submodules) < len(names):
        yield _Import(module, source, node.lineno, tuple(names))


def _inside() -> list[_Import]:
    """Return the imports from one of our modules to another."""
    return [found for found in _imports() if found.imported.split(".")[0] in ("orchestra", "bringup")]


def test_every_room_has_its_place() -> None:
    rooms = {_room(module) for module in _modules() if module.startswith("orchestra.")}
    assert rooms <= {*_LEVELS, "ros"}


def test_imports_point_one_way() -> None:
    assert not [str(found) for found in _inside() if _points_up(_room(found.importer), _room(found.imported))]


def _points_up(importer: str, imported: str) -> bool:
    """Tell whether one room must not import the other; rooms without a level have tests of their own."""
    if importer == imported or importer not in _LEVELS or imported not in _LEVELS:
        return False
    return _LEVELS[imported] > _LEVELS[importer] or {importer, imported} <= _CLIENTS


def test_nobody_imports_the_public_surface_from_within() -> None:
    """It reaches up to the pipeline, so a module below that imported it would close a circle."""
    assert not [str(found) for found in _inside() if found.imported == "orchestra"]


def test_no_modules_import_each_other_in_a_circle() -> None:
    edges: dict[str, set[str]] = {}
    for found in _inside():
        if found.importer != "orchestra":
            edges.setdefault(found.importer, set()).add(found.imported)
    try:
        TopologicalSorter(edges).prepare()
    except CycleError as error:
        pytest.fail(f"imports in a circle: {' -> '.join(reversed(error.args[1]))}")


def test_what_runs_beside_the_nodes_needs_the_standard_library_alone() -> None:
    wrong = [
        str(found)
        for found in _imports()
        if (_room(found.importer) in _SMALL_ROOMS or found.importer in _SMALL_CORE)
        and not _is_standard(found.imported)
        and _room(found.imported) not in _SMALL_ROOMS
        and found.imported not in _SMALL_CORE
    ]
    assert not wrong


def test_only_the_ros_room_and_the_bringup_import_ros() -> None:
    wrong = [
        str(found)
        for found in _imports()
        if found.imported.split(".")[0] in ("rclpy", "rosidl_runtime_py", "rcl_interfaces")
        and _room(found.importer) != "ros"
        and not found.importer.startswith("bringup")
    ]
    assert not wrong


def test_nobody_imports_the_ros_room_but_the_bringup_its_interfaces() -> None:
    """The room is run as `python -m`, so that no process of ours carries rclpy without need."""
    wrong = [
        str(found)
        for found in _inside()
        if _room(found.imported) == "ros"
        and found.imported.startswith("orchestra.")
        and not found.importer.startswith("orchestra.ros")
        and not (
            found.importer.startswith("bringup") and found.imported.startswith("orchestra.ros.interfaces")
        )
    ]
    assert not wrong


def test_the_bringup_uses_nothing_else_of_ours() -> None:
    wrong = [
        str(found)
        for found in _inside()
        if found.importer.startswith("bringup")
        and found.imported.startswith("orchestra")
        and not found.imported.startswith("orchestra.ros.interfaces")
    ]
    assert not wrong
    assert not [
        str(found)
        for found in _inside()
        if found.importer.startswith("orchestra") and found.imported.startswith("bringup")
    ]


@pytest.mark.parametrize("path", _files(), ids=_module)
def test_modules_and_functions_stay_small(path: Path) -> None:
    source = path.read_text("utf-8")
    assert source.count("\n") <= _LONGEST_MODULE
    long = [
        f"{node.name} has {node.end_lineno - node.lineno + 1} lines"
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        and node.end_lineno is not None
        and node.end_lineno - node.lineno + 1 > _LONGEST_FUNCTION
    ]
    assert not long


def _is_standard(module: str) -> bool:
    return module.split(".", maxsplit=1)[0] in sys.stdlib_module_names

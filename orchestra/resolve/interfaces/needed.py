"""What nodes need of packages of definitions that are here as sources only: they are built, and their nodes find them.

A node of a Python package needs what the `package.xml` of that package names, as far as it is not installed and is
found as a source (`sources`), or Orchestra brings its definitions (tf2_msgs). The node then gets the prefixes on its
PYTHONPATH and AMENT_PREFIX_PATH. Where processes are to be started, what is not built yet is built now; else only the
definitions are looked at.
"""

from __future__ import annotations

import json
import os
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.errors import Code, Problem, Severity
from orchestra.fields import replace
from orchestra.location import Span
from orchestra.resolve.interfaces import prefixes, sources
from orchestra.resolve.interfaces.available import built, provided
from orchestra.resolve.model import EnvironmentChange
from orchestra.resolve.packages import ament, manifest_beside, manifest_of, may_need_definitions

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from orchestra.errors import Problems
    from orchestra.resolve.context import CommandResult
    from orchestra.resolve.inputs import Inputs
    from orchestra.resolve.interfaces.prefixes import Cache
    from orchestra.resolve.interfaces.sources import Source
    from orchestra.resolve.model import Resolved, ResolvedProcess

_TOOL: Final = str(Path(__file__).parents[2] / "ros" / "tools" / "__main__.py")
_SECONDS: Final = 900.0  # that a build may take


def with_definitions(
    resolved: Resolved, inputs: Inputs, problems: Problems, run_command: Callable[..., CommandResult]
) -> Resolved:
    """Return what was resolved, with the packages of definitions that its nodes need in their environments."""
    cache = prefixes.this_cache(inputs.environment)
    if cache is None:
        return resolved
    packages = _packages(resolved)
    paths: dict[Path, tuple[Path, ...]] = {}
    for folder in dict.fromkeys(folder for folders in packages.values() for folder in folders):
        needed, known = _wanted(folder, inputs.environment)
        if needed and _are_built(needed, known, cache, inputs, problems, run_command):
            paths[folder] = tuple(prefixes.prefix_of(source, known, cache) for source in needed)
    if not paths:
        return resolved
    found = {
        index: [path for folder in folders for path in paths.get(folder, ())]
        for index, folders in packages.items()
    }
    processes = [
        _finding(process, found[index], inputs.environment) if found.get(index) else process
        for index, process in enumerate(resolved.processes)
    ]
    return replace(resolved, processes=tuple(processes))


def _packages(resolved: Resolved) -> dict[int, list[Path]]:
    """Return the folders of the Python packages that each process needs: its own, and those of its components."""
    found: dict[int, list[Path]] = {}
    for index, process in enumerate(resolved.processes):
        manifest = manifest_of(process) if may_need_definitions(process) else None
        if manifest is not None:
            found.setdefault(index, []).append(Path(manifest).parent)
    for component in resolved.components:
        manifest = manifest_beside(component.share) if component.share else None
        if manifest is not None and component.container_process is not None:
            found.setdefault(component.container_process, []).append(Path(manifest).parent)
    return found


def _wanted(folder: Path, environment: Mapping[str, str]) -> tuple[tuple[Source, ...], dict[str, Source]]:
    """Return the packages that one needs as sources, each after those that it needs, and all that are known."""
    missing = [name for name in sources.dependencies(folder) if not _is_installed(name, environment)]
    if not missing:
        return (), {}
    known = provided()
    if any(name not in known for name in missing):
        known |= built(environment) | sources.found_in(sources.places(folder, environment))
    found: dict[str, Source] = {}
    for name in missing:
        _add(name, known, found, environment)
    return tuple(found.values()), known


def _add(
    name: str, known: Mapping[str, Source], found: dict[str, Source], environment: Mapping[str, str]
) -> None:
    source = known.get(name)
    if source is None or name in found or _is_installed(name, environment):
        return
    for other in sorted(sources.mentioned(source)):
        if other != name:
            _add(other, {key: value for key, value in known.items() if key != name}, found, environment)
    found[name] = source


def _is_installed(name: str, environment: Mapping[str, str]) -> bool:
    if any(ament.has(prefix, name) for prefix in ament.prefixes(environment)):
        return True
    spec = find_spec(name) if name.isidentifier() else None
    # A folder without code is no package, and what this process has made of definitions is in no other one.
    return spec is not None and spec.has_location


def _are_built(
    needed: tuple[Source, ...],
    known: Mapping[str, Source],
    cache: Cache,
    inputs: Inputs,
    problems: Problems,
    run_command: Callable[..., CommandResult],
) -> bool:
    """Build what is not yet, or look at the definitions; tell whether nothing is wrong with them."""
    todo = [source for source in needed if not prefixes.prefix_of(source, known, cache).is_dir()]
    if not todo:
        return True
    options = {
        "paths": [str(source.folder) for source in todo],
        "without_compiler": not cache.compiles,
        "only_check": not inputs.launching,
        "format": "json",
    }
    question = {"command": "interface build", "tool": "building:build", "options": options}
    if inputs.launching and cache.compiles:
        names = ", ".join(source.name for source in todo)
        sys.stderr.write(f"[orchestra] compiling the definitions of {names}, which is done once\n")
        sys.stderr.flush()
    command = (sys.executable, "-P", _TOOL, json.dumps(question))
    done = run_command(command, inputs.environment, timeout=_SECONDS)
    found = list(_told(done.stderr))
    problems.extend(found)
    if done.failure or (done.status != 0 and not found):
        names = ", ".join(source.name for source in todo)
        told = done.failure or (done.stderr.strip().splitlines() or [f"it ended with {done.status}"])[-1]
        problems.error(Code.BAD_DEFINITION, f"{names} cannot be built: {told}")
        return False
    return not found


def _told(text: str) -> Iterator[Problem]:
    """Yield the problems that the building process has told, in JSON."""
    begin = text.find("[")
    try:
        found: list[dict[str, Any]] = json.loads(text[begin:]) if begin >= 0 else []
    except ValueError:
        return
    for item in found:
        span = Span(item["file"], *(item[name] for name in ("line", "column", "end_line", "end_column")))
        yield Problem(Code(item["code"]), Severity(item["severity"]), item["message"], span)


def _finding(
    process: ResolvedProcess, found: Sequence[Path], environment: Mapping[str, str]
) -> ResolvedProcess:
    """Return a process whose environment has the prefixes that its packages need."""
    python = [str(prefixes.python_folder(prefix)) for prefix in found]
    index = [*map(str, found), *map(str, ament.prefixes(environment))]
    changes = {
        "PYTHONPATH": _before(python, "PYTHONPATH", process, environment),
        "AMENT_PREFIX_PATH": _before(index, "AMENT_PREFIX_PATH", process, environment),
    }
    made = {
        name: (*process.environment.get(name, ()), EnvironmentChange(value, process.location))
        for name, value in changes.items()
    }
    return replace(process, environment={**process.environment, **made})


def _before(folders: list[str], name: str, process: ResolvedProcess, environment: Mapping[str, str]) -> str:
    """Return the value of a variable with folders in front of what it would be."""
    given = process.environment.get(name)
    value = given[-1].value if given else environment.get(name)
    return os.pathsep.join(dict.fromkeys([*folders, *filter(None, (value or "").split(os.pathsep))]))

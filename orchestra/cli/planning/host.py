"""What this machine has to do with a plan: what a run adds to environments here, paths that differ elsewhere."""

from __future__ import annotations

import os
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.plan.portable import HOME, PYTHON, PYTHON_PREFIX, WORKING_DIRECTORY
from orchestra.plan.render.setting import Additions
from orchestra.resolve.packages import InstalledPackages
from orchestra.supervise.environment import node_environment
from orchestra.supervise.graph.discovery import quick_discovery
from orchestra.supervise.host import this_host
from orchestra.supervise.keeping.marks import PROCESS, RUN
from orchestra.wheels import LIBRARY_PATH, as_called

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.plan.model import Plan

_LOGS: Final = "${run}/logs/ros"
_PREFIXES: Final = "AMENT_PREFIX_PATH"
_LISTS: Final = (LIBRARY_PATH, _PREFIXES, "PATH")
_FIRST: tuple[str, ...] = (LIBRARY_PATH, "PATH")


def additions(files: Mapping[str, bytes]) -> Additions:
    """Return what a run that is started here and now adds; `files` are those that it brings along."""
    caller = as_called(os.environ)
    host = this_host()
    with tempfile.TemporaryDirectory() as folder:
        discovery = quick_discovery(caller, Path(folder))
        profiles = {f"${{run}}/{path.name}": path.read_bytes() for path in Path(folder).iterdir()}
        discovery = {name: value.replace(folder, "${run}") for name, value in discovery.items()}
    plain = {name: value for name, value in caller.items() if name not in _LISTS}
    whole = node_environment(plain, host, {}, log_folder=_LOGS, colour=False, marks=("", ""), inherit=True)
    bare = node_environment({}, host, {}, log_folder=_LOGS, colour=False, marks=("", ""), inherit=False)
    before = {name: whole[name] for name in _FIRST if name in whole}
    if host.path in caller.get("PATH", "").split(":"):
        before.pop("PATH", None)  # whoever has chosen an order keeps it
    changed = {name: value for name, value in whole.items() if plain.get(name) != value}
    return Additions(
        {**_without(changed, *_LISTS), **discovery},
        before,
        {_PREFIXES: whole[_PREFIXES]} if _PREFIXES in whole else {},
        _without(bare),
        {**profiles, **files},
    )


def _without(environment: Mapping[str, str], *names: str) -> dict[str, str]:
    """Return what is not different for each process."""
    return {name: value for name, value in environment.items() if name not in (*names, RUN, PROCESS)}


def inherited() -> dict[str, str]:
    """Return the environment of a process for which the description changes nothing."""
    caller = as_called(os.environ)
    found = additions({})
    environment = {**caller, **found.variables}
    for name, entries in found.before.items():
        environment[name] = ":".join(filter(None, (entries, caller.get(name))))
    for name, entries in found.after.items():
        environment[name] = ":".join(filter(None, (caller.get(name), entries)))
    return environment


def symbols(plan: Plan) -> dict[str, str]:
    """Return what stands for paths of this machine in a portable plan, by the paths."""
    packages = InstalledPackages(as_called(os.environ))
    found = {} if (home := os.path.expanduser("~")) == "~" else {home: HOME}  # noqa: PTH111 - nobody may have none
    found[sys.prefix] = PYTHON_PREFIX
    named = [process.package for process in plan.processes] + [item.package for item in plan.components]
    for package in sorted({*packages.names(), *(name for name in named if name is not None)}):
        prefix, share = packages.prefix(package), packages.share(package)
        if prefix is not None and prefix not in (sys.prefix, "/"):
            found.setdefault(prefix, f"${{prefix:{package}}}")
        if share is not None:
            found[share] = f"${{share:{package}}}"
    found[str(Path.cwd())] = WORKING_DIRECTORY
    found[sys.executable] = PYTHON
    return found

"""Programs in Python without an executable: modules and scripts, run by the interpreter that runs Orchestra."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.errors import HERE, Code, Severity
from orchestra.nearest import is_slip
from orchestra.resolve.context import POISON
from orchestra.resolve.packages.modules import Unrunnable, unrunnable
from orchestra.resolve.paths import existing_file
from orchestra.resolve.refusals import refuse_value
from orchestra.witness.once import once

if TYPE_CHECKING:
    from orchestra.description.actions.node import Node
    from orchestra.description.text import Template
    from orchestra.resolve.context import Poison, Value
    from orchestra.resolve.resolution import Resolution

# Variables that decide where the interpreter of a node looks for modules.
PATHS: Final = frozenset({"PYTHONPATH", "PYTHONHOME", "PYTHONSAFEPATH"})


def module_words(module: Value, action: Node, run: Resolution) -> tuple[str, ...] | Poison:
    """Return the words that run a module; one that is not here is reported.

    Where nothing is started another environment may have it: then it is no error, unless its name is a slip.
    """
    words = (sys.executable, "-m", module.text)
    fault = module_fault(module.text, action, run)
    if fault is None:
        return words
    weight = run.inputs.weights.package
    if fault.certain or weight is Severity.ERROR or is_slip_of(module.text, fault):
        return refuse_value(module, run.problems, Code.MISSING_EXECUTABLE, fault.told, meant=fault.meant)
    run.problems.weighed(weight, Code.MISSING_EXECUTABLE, f"{fault.told} {HERE}", module.location)
    return words


def script_words(script: Value, written: Template, run: Resolution) -> tuple[str, ...] | Poison:
    """Return the words that run a script, which is beside the launch file or below the working directory."""
    path = existing_file(script, written, "script", run)
    return POISON if path is None else (sys.executable, path)


def module_fault(module: str, action: Node, run: Resolution) -> Unrunnable | None:
    """Return why a node's module cannot be run, None where nobody can tell: with a path of its own."""
    own = {pair.name.constant for pair in (*(action.env_only or ()), *action.env)}
    cwd = "." if action.cwd is None else action.cwd.constant
    if cwd is None or None in own or PATHS & {*own, *run.scope.changes}:
        return None
    folder = str(Path.cwd() / cwd)
    return once(("module", module, folder, *sys.path), lambda: unrunnable(module, folder))


def is_slip_of(module: str, fault: Unrunnable) -> bool:
    """Return whether a module's name is hardly anything but a slip for the one that was meant."""
    return fault.meant is not None and is_slip(module, fault.meant)

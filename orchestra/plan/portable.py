"""A plan without what differs from machine to machine: the interpreter, where packages are, the working directory.

Such a plan says the same wherever it is made, so that it can be committed and compared. It cannot be run.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from orchestra.fields import replace
from orchestra.plan.digest import digest
from orchestra.plan.relocated import rewritten

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.plan.model import Plan

# What stands for a path: these, and `${share:PKG}` and `${prefix:PKG}` for the folders of a package.
PYTHON, PYTHON_PREFIX, WORKING_DIRECTORY, HOME = "${python}", "${python_prefix}", "${cwd}", "${home}"
_SYMBOL = re.compile(r"\$\{(?:python|python_prefix|cwd|home|share:[^}]*|prefix:[^}]*)\}")
# A path begins and ends where no further character of a name stands.
_NO_NAME_BEFORE, _NO_MORE_NAME = r"(?<![\w.+-])", r"(?![\w.+-])"


def portable(plan: Plan, symbols: Mapping[str, str]) -> Plan:
    """Return the plan with each of the paths replaced by its symbol, the longest one where several fit.

    Digests are those of what then stands in the plan.
    """
    paths = sorted((path for path in symbols if path not in ("", "/")), key=len, reverse=True)
    if not paths:
        return plan
    plan = replace(plan, processes=tuple(replace(process, warm=None) for process in plan.processes))
    known = re.compile(f"{_NO_NAME_BEFORE}(?:{'|'.join(map(re.escape, paths))}){_NO_MORE_NAME}")
    return redigested(rewritten(plan, lambda text: known.sub(lambda found: symbols[found[0]], text)))


def redigested(plan: Plan) -> Plan:
    """Return a plan whose texts have been changed, with the digests of what stands in it now."""
    processes = (replace(process, digest=digest(process)) for process in plan.processes)
    return replace(plan, processes=tuple(processes))


def is_portable(plan: Plan) -> bool:
    """Return whether symbols of this kind stand in the commands of a plan."""
    return any(_SYMBOL.search(word) for process in plan.processes for word in process.command)

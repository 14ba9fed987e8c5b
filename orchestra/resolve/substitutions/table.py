"""Which function performs which substitution; `orchestra.description.substitutions` says what each takes.

Modules are imported when a substitution of theirs is performed for the first time: few launch files have many kinds.
"""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from orchestra.resolve.substitutions.arguments import Substitution

SUBSTITUTIONS: Final[dict[str, str]] = {
    "all": "logic.conjunction",
    "and": "logic.conjunction",
    "anon": "anon.perform",
    "any": "logic.disjunction",
    "command": "command.perform",
    "dirname": "current_file.dirname",
    "env": "env.perform",
    "equals": "equality.equals",
    "eval": "eval.perform",
    "exec-in-pkg": "exec_in_pkg.perform",
    "file-content": "file_content.perform",
    "filename": "current_file.filename",
    "find-exec": "find_exec.perform",
    "find-pkg-prefix": "find_package.prefix",
    "find-pkg-share": "find_package.share",
    "for-var": "turn.perform",
    "if": "choice.perform",
    "index": "turn.perform",
    "launch_log_dir": "log_folder.perform",
    "log_dir": "log_folder.perform",
    "not": "logic.negation",
    "not-equals": "equality.not_equals",
    "or": "logic.disjunction",
    "param": "param.perform",
    "path-join": "joining.path",
    "string-join": "joining.string",
    "var": "var.perform",
    "yaml-value": "yaml_value.perform",
}


@cache
def performing(name: str) -> Substitution:
    """Return the function that performs a substitution."""
    module, _, function = SUBSTITUTIONS[name].partition(".")
    performs: Substitution = getattr(import_module(f"{__package__}.{module}"), function)
    return performs

"""Which function performs which substitution; `orchestra.description.substitutions` says what each takes."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from orchestra.resolve.substitutions import (
    anon,
    choice,
    command,
    current_file,
    env,
    equality,
    eval,  # noqa: A004 - the substitution's name
    exec_in_pkg,
    file_content,
    find_exec,
    find_package,
    joining,
    log_folder,
    logic,
    param,
    turn,
    var,
    yaml_value,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.resolve.substitutions.arguments import Substitution

SUBSTITUTIONS: Final[Mapping[str, Substitution]] = MappingProxyType({
    "all": logic.conjunction,
    "and": logic.conjunction,
    "anon": anon.perform,
    "any": logic.disjunction,
    "command": command.perform,
    "dirname": current_file.dirname,
    "env": env.perform,
    "equals": equality.equals,
    "eval": eval.perform,
    "exec-in-pkg": exec_in_pkg.perform,
    "file-content": file_content.perform,
    "filename": current_file.filename,
    "find-exec": find_exec.perform,
    "find-pkg-prefix": find_package.prefix,
    "find-pkg-share": find_package.share,
    "for-var": turn.perform,
    "if": choice.perform,
    "index": turn.perform,
    "launch_log_dir": log_folder.perform,
    "log_dir": log_folder.perform,
    "not": logic.negation,
    "not-equals": equality.not_equals,
    "or": logic.disjunction,
    "param": param.perform,
    "path-join": joining.path,
    "string-join": joining.string,
    "var": var.perform,
    "yaml-value": yaml_value.perform,
})  # fmt: skip

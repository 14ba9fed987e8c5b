"""The substitutions that may stand in XML and YAML: `$(name argument ...)`, with what each takes."""

from __future__ import annotations

from types import MappingProxyType
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.dataclass import dataclass

if TYPE_CHECKING:
    from collections.abc import Mapping


class Shape(NamedTuple):
    """A template without a place: offsets in the text stand for spans."""

    parts: tuple[Part, ...]
    raw: str
    begin: int
    end: int
    quoted: bool


class Part(NamedTuple):
    """Words, or a call: its name, and its arguments."""

    text: str
    arguments: tuple[Shape, ...] | None
    begin: int
    end: int


@dataclass(frozen=True, slots=True)
class Signature:
    """What a substitution takes: `maximum` is None where any number of arguments may follow.

    `phrase` says that the first argument is usually several words, which then stand in quotes together.
    """

    arguments: tuple[str, ...]
    minimum: int
    maximum: int | None
    summary: str
    phrase: bool = False


def _takes(*arguments: str, summary: str, phrase: bool = False) -> Signature:
    """Return the signature whose optional arguments are written in brackets, a repeated one with dots."""
    names = tuple(argument.strip("[.]") for argument in arguments)
    required = sum(argument[0] != "[" for argument in arguments)
    repeated = any(argument.endswith("...]") for argument in arguments)
    return Signature(names, required, None if repeated else len(names), summary, phrase)


SIGNATURES: Final[Mapping[str, Signature]] = MappingProxyType({
    "all": _takes("[value...]", summary="true where every value is true"),
    "and": _takes("left", "right", summary="true where both values are true"),
    "anon": _takes("name", summary="the name made unique; the same name gives the same result again"),
    "any": _takes("[value...]", summary="true where at least one value is true"),
    "command": _takes(
        "command",
        "[on_stderr]",
        summary="what a command prints; on_stderr is fail, ignore, warn or capture",
        phrase=True,
    ),
    "dirname": _takes(summary="the folder of this launch file"),
    "env": _takes("name", "[default]", summary="an environment variable"),
    "equals": _takes("left", "right", summary="true where both are equal as booleans, numbers or text"),
    "eval": _takes(
        "expression", "[modules]", summary="the result of a Python expression, which may use math", phrase=True
    ),
    "exec-in-pkg": _takes("executable", "package", summary="the path of a package's executable"),
    "file-content": _takes("path", summary="the text of a file"),
    "filename": _takes(summary="the path of this launch file"),
    "find-exec": _takes("name", summary="the path of a program on the PATH"),
    "find-pkg-prefix": _takes("package", summary="the install prefix of a package"),
    "find-pkg-share": _takes("package", summary="the share folder of a package"),
    "for-var": _takes("name", "[default]", summary="a value of the mapping that a for_each is at"),
    "if": _takes("condition", "value", "[else]", summary="the value where the condition is true, else the other"),
    "index": _takes("name", summary="how often a for has been carried out before"),
    "launch_log_dir": _takes(summary="the log folder of this run"),
    "log_dir": _takes(summary="the log folder of this run"),
    "not": _takes("value", summary="true where the value is false"),
    "not-equals": _takes("left", "right", summary="true where equals is false"),
    "or": _takes("left", "right", summary="true where at least one of two values is true"),
    "param": _takes("name", "[default]", summary="a parameter that set_parameter put in scope"),
    "path-join": _takes(
        "component", "[component...]", summary="a path of its parts; an absolute one discards those before it"
    ),
    "string-join": _takes("delimiter", "[text...]", summary="texts with a delimiter between them"),
    "var": _takes("name", "[default]", summary="a launch argument or variable"),
    "yaml-value": _takes(
        "path",
        "key",
        "[default]",
        summary="what stands in a YAML file under a key (a.b); of a list the items, of a mapping the keys, with commas",
    ),
})  # fmt: skip

# What people write who come from ROS 1, from Python or from a later distribution.
ELSEWHERE: Final[Mapping[str, str]] = MappingProxyType({
    "ament_index": "find-pkg-share",
    "anon_name": "anon",
    "arg": "var",
    "bash": "command",
    "cmd": "command",
    "conf": "var",
    "config": "var",
    "configuration": "var",
    "current_dir": "dirname",
    "current_file": "filename",
    "cwd": "dirname",
    "dir": "dirname",
    "env_var": "env",
    "environ": "env",
    "environment": "env",
    "environment_variable": "env",
    "eq": "equals",
    "equals_substitution": "equals",
    "executable_in_package": "exec-in-pkg",
    "expr": "eval",
    "file": "filename",
    "find": "find-pkg-share",
    "find_executable": "find-exec",
    "find_package": "find-pkg-share",
    "find_package_prefix": "find-pkg-prefix",
    "find_package_share": "find-pkg-share",
    "find_pkg": "find-pkg-share",
    "find_share": "find-pkg-share",
    "get_env": "env",
    "get_environment": "env",
    "get_package_prefix": "find-pkg-prefix",
    "get_package_share_directory": "find-pkg-share",
    "get_var": "var",
    "getenv": "env",
    "if_else": "if",
    "if_else_substitution": "if",
    "join": "path-join",
    "launch_arg": "var",
    "launch_argument": "var",
    "launch_config": "var",
    "launch_configuration": "var",
    "launch_configuration_equals": "equals",
    "launch_dir": "dirname",
    "ne": "not-equals",
    "neq": "not-equals",
    "not_equals_substitution": "not-equals",
    "optenv": "env",
    "os_environ": "env",
    "os_path_join": "path-join",
    "package": "find-pkg-share",
    "package_dir": "find-pkg-share",
    "package_path": "find-pkg-share",
    "package_prefix": "find-pkg-prefix",
    "package_share": "find-pkg-share",
    "parameter": "param",
    "path_join_substitution": "path-join",
    "pkg": "find-pkg-share",
    "pkg_dir": "find-pkg-share",
    "pkg_path": "find-pkg-share",
    "pkg_prefix": "find-pkg-prefix",
    "pkg_share": "find-pkg-share",
    "pwd": "dirname",
    "py": "eval",
    "python": "eval",
    "python_expression": "eval",
    "run": "command",
    "sh": "command",
    "share": "find-pkg-share",
    "shell": "command",
    "string_join_substitution": "string-join",
    "system": "command",
    "this_dir": "dirname",
    "this_file": "filename",
    "this_file_dir": "dirname",
    "this_launch_file": "filename",
    "this_launch_file_dir": "dirname",
    "value": "var",
    "variable": "var",
})  # fmt: skip

"""What launch files import as `launch.substitutions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "AllSubstitution": "boolean_substitution",
    "AndSubstitution": "boolean_substitution",
    "AnonName": "anon_name",
    "AnySubstitution": "boolean_substitution",
    "Command": "command",
    "EnvironmentVariable": "environment_variable",
    "EqualsSubstitution": "equals_substitution",
    "FileContent": "file_content",
    "FindExecutable": "find_executable",
    "ForEachVar": "for_loop_var",
    "ForLoopIndex": "for_loop_var",
    "IfElseSubstitution": "if_else_substitution",
    "LaunchConfiguration": "launch_configuration",
    "LaunchLogDir": "launch_log_dir",
    "LocalSubstitution": "local_substitution",
    "NotEqualsSubstitution": "not_equals_substitution",
    "NotSubstitution": "boolean_substitution",
    "OrSubstitution": "boolean_substitution",
    "PathJoinSubstitution": "path_join_substitution",
    "PathSubstitution": "path_substitution",
    "PythonExpression": "python_expression",
    "StringJoinSubstitution": "string_join_substitution",
    "SubstitutionFailure": "substitution_failure",
    "TextSubstitution": "text_substitution",
    "ThisLaunchFile": "this_launch_file",
    "ThisLaunchFileDir": "this_launch_file_dir",
    "YamlValue": "yaml_value",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)

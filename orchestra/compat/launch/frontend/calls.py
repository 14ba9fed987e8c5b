"""Which substitution a name in `$(name argument ...)` stands for."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any, Final

from orchestra.compat.launch.frontend.classes import class_at

CALLS: Final = MappingProxyType({
    "all": "launch:AllSubstitution",
    "and": "launch:AndSubstitution",
    "anon": "launch:AnonName",
    "any": "launch:AnySubstitution",
    "command": "launch:Command",
    "dirname": "launch:ThisLaunchFileDir",
    "env": "launch:EnvironmentVariable",
    "equals": "launch:EqualsSubstitution",
    "eval": "launch:PythonExpression",
    "exec-in-pkg": "launch_ros:ExecutableInPackage",
    "file-content": "launch:FileContent",
    "filename": "launch:ThisLaunchFile",
    "find-exec": "launch:FindExecutable",
    "find-pkg-prefix": "launch_ros:FindPackagePrefix",
    "find-pkg-share": "launch_ros:FindPackageShare",
    "for-var": "launch:ForEachVar",
    "if": "launch:IfElseSubstitution",
    "index": "launch:ForLoopIndex",
    "launch_log_dir": "launch:LaunchLogDir",
    "log_dir": "launch:LaunchLogDir",
    "not": "launch:NotSubstitution",
    "not-equals": "launch:NotEqualsSubstitution",
    "or": "launch:OrSubstitution",
    "param": "launch_ros:Parameter",
    "path-join": "launch:PathJoinSubstitution",
    "string-join": "launch:StringJoinSubstitution",
    "var": "launch:LaunchConfiguration",
    "yaml-value": "launch:YamlValue",
})  # fmt: skip


def class_of_call(name: str) -> Any:
    """Return the class that a name of the launch language stands for."""
    return class_at(CALLS[name], "substitutions")

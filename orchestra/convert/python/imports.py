"""Where the names of launch files are imported from, upstream's all of them, and the lines that import those in use."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

_WIDEST = 88
_MODULES: Final = {
    "launch": ("LaunchDescription",),
    "launch.actions": (
        *("AppendEnvironmentVariable", "DeclareLaunchArgument", "ExecuteProcess", "GroupAction"),
        *("IncludeLaunchDescription", "Log", "LogDebug", "LogError", "LogInfo", "LogWarning"),
        *("ResetEnvironment", "ResetLaunchConfigurations", "SetEnvironmentVariable"),
        *("SetLaunchConfiguration", "Shutdown", "TimerAction", "UnsetEnvironmentVariable"),
    ),
    "launch.conditions": ("IfCondition", "UnlessCondition"),
    "launch.launch_description_sources": ("AnyLaunchDescriptionSource", "PythonLaunchDescriptionSource"),
    "launch.substitutions": (
        *("AllSubstitution", "AndSubstitution", "AnonName", "AnySubstitution", "Command"),
        *("EnvironmentVariable", "EqualsSubstitution", "FileContent", "FindExecutable"),
        *("IfElseSubstitution", "LaunchConfiguration", "LaunchLogDir", "NotEqualsSubstitution"),
        *("NotSubstitution", "OrSubstitution", "PathJoinSubstitution", "PythonExpression"),
        *("StringJoinSubstitution", "TextSubstitution", "ThisLaunchFile", "ThisLaunchFileDir"),
        "YamlValue",
    ),
    "launch_ros.actions": (
        *("ComposableNodeContainer", "LifecycleNode", "LoadComposableNodes", "Node", "PushROSNamespace"),
        *("RosTimer", "SetParameter", "SetParametersFromFile", "SetRemap", "SetROSLogDir", "SetUseSimTime"),
    ),
    "launch_ros.descriptions": (
        *("ComposableLifecycleNode", "ComposableNode", "Parameter", "ParameterFile", "ParameterValue"),
    ),
    "launch_ros.substitutions": (*("ExecutableInPackage", "FindPackagePrefix", "FindPackageShare"),),
    "typing": ("List",),
}
# The substitution and the description of this name are two classes.
PARAMETER_SUBSTITUTION: Final = "Parameter as ParameterSubstitution"
_PLACES: Final = {name: module for module, names in _MODULES.items() for name in names} | {
    PARAMETER_SUBSTITUTION: "launch_ros.substitutions"
}


def import_lines(names: Iterable[str]) -> Iterator[str]:
    """Yield the lines that import some names, sorted as isort does, the standard library apart."""
    by_module: dict[str, list[str]] = {}
    for name in names:
        by_module.setdefault(_PLACES[name], []).append(name)
    standard = [module for module in by_module if module == "typing"]
    for module in standard:
        yield from _lines(module, by_module.pop(module))
    if standard and by_module:
        yield ""
    for module in sorted(by_module):
        yield from _lines(module, by_module[module])


def _lines(module: str, names: list[str]) -> Iterator[str]:
    ordered = sorted(names, key=lambda name: (name.lower(), name))
    line = f"from {module} import {', '.join(ordered)}"
    if len(line) <= _WIDEST:
        yield line
        return
    yield f"from {module} import ("
    yield from (f"    {name}," for name in ordered)
    yield ")"

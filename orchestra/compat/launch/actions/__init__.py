"""What launch files import as `launch.actions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "AppendEnvironmentVariable": "append_environment_variable",
    "DeclareBooleanLaunchArgument": "declare_boolean_launch_argument",
    "DeclareLaunchArgument": "declare_launch_argument",
    "EmitEvent": "emit_event",
    "ExecuteLocal": "execute_local",
    "ExecuteProcess": "execute_process",
    "ForEach": "for_loop",
    "ForLoop": "for_loop",
    "GroupAction": "group_action",
    "IncludeLaunchDescription": "include_launch_description",
    "Log": "log",
    "LogDebug": "log",
    "LogError": "log",
    "LogInfo": "log_info",
    "LogWarning": "log",
    "OpaqueCoroutine": "opaque_coroutine",
    "OpaqueFunction": "opaque_function",
    "PopEnvironment": "pop_environment",
    "PopLaunchConfigurations": "pop_launch_configurations",
    "PushEnvironment": "push_environment",
    "PushLaunchConfigurations": "push_launch_configurations",
    "RegisterEventHandler": "register_event_handler",
    "ResetEnvironment": "reset_environment",
    "ResetLaunchConfigurations": "reset_launch_configurations",
    "SetEnvironmentVariable": "set_environment_variable",
    "SetLaunchConfiguration": "set_launch_configuration",
    "Shutdown": "shutdown_action",
    "TimerAction": "timer_action",
    "UnregisterEventHandler": "unregister_event_handler",
    "UnsetEnvironmentVariable": "unset_environment_variable",
    "UnsetLaunchConfiguration": "unset_launch_configuration",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)

"""Every class and function that launch files call takes the arguments that it takes in ROS 2 Jazzy.

Newer releases may add arguments that nobody has to give.
"""

from __future__ import annotations

import inspect
from importlib import import_module
from inspect import Parameter
from typing import Any

import pytest

from tests.conformance.marks import conforming

_ANY = object()  # a default that is another object here, and means the same
# What may be left out where another argument of ours stands for it: the constructor refuses to be without both.
_STARTED = dict.fromkeys(("Node", "LifecycleNode", "ComposableNodeContainer"), "executable")
_POSITIONAL = (Parameter.POSITIONAL_ONLY, Parameter.POSITIONAL_OR_KEYWORD)
_PROCESS = (
    "shell=False, sigterm_timeout=ANY, sigkill_timeout=ANY, emulate_tty=ANY, output=ANY, output_format=ANY, "
    "cached_output=False, log_cmd=False, on_exit=None, respawn=False, respawn_delay=None, respawn_max_retries=-1, "
    "condition=None"
)
_PROGRAM = "prefix=None, name=None, cwd=None, env=None, additional_env=None"
_NODE = f"parameters=None, remappings=None, ros_arguments=None, arguments=None, exec_name=None, {_PROCESS}"
_RUNNING = "action, name, cmd, cwd, env, pid"
_HANDLER = "handle_once=False"

# Row -> module, name, and what is taken, as Python writes it.
SIGNATURES: dict[str, tuple[str, str, str]] = {
    "1.2 Action constructor": ("launch", "Action", "*, condition=None"),
    "1.2 LaunchDescription constructor": (
        "launch", "LaunchDescription", "initial_entities=None, *, deprecated_reason=None",
    ),
    "1.2 LaunchContext constructor": ("launch", "LaunchContext", "*, argv=None, noninteractive=False"),
    "1.2 LaunchContext.register_event_handler": (
        "launch", "LaunchContext.register_event_handler", "self, event_handler, append=False",
    ),
    "1.2 LaunchService constructor": ("launch", "LaunchService", "*, argv=None, noninteractive=False, debug=False"),
    "1.2 LaunchService.run": ("launch", "LaunchService.run", "self, *, shutdown_when_idle=True"),
    "1.2 LaunchService.run_async": ("launch", "LaunchService.run_async", "self, *, shutdown_when_idle=True"),
    "1.2 LaunchService.shutdown": ("launch", "LaunchService.shutdown", "self, force_sync=False"),
    "1.2 LaunchDescription.get_launch_arguments": (
        "launch", "LaunchDescription.get_launch_arguments", "self, conditional_inclusion=False",
    ),
    "1.2 InvalidLaunchFileError": ("launch", "InvalidLaunchFileError", "extension='', *, likely_errors=None"),
    "1.2 Condition": ("launch", "Condition", "*, predicate=None"),
    "1.2 LaunchDescriptionSource": (
        "launch", "LaunchDescriptionSource",
        "launch_description=None, location='<string>', method='unspecified mechanism from a script'",
    ),
    "1.3 AppendEnvironmentVariable": (
        "launch.actions", "AppendEnvironmentVariable", "name, value, prepend=False, separator=':', *, condition=None",
    ),
    "1.3 DeclareLaunchArgument": (
        "launch.actions", "DeclareLaunchArgument",
        "name, *, default_value=None, description=None, choices=None, condition=None",
    ),
    "1.3 EmitEvent": ("launch.actions", "EmitEvent", "*, event, condition=None"),
    "1.3 ExecuteLocal": ("launch.actions", "ExecuteLocal", f"*, process_description, {_PROCESS}"),
    "1.3 ExecuteProcess": ("launch.actions", "ExecuteProcess", f"*, cmd, {_PROGRAM}, {_PROCESS}"),
    "1.3 GroupAction": (
        "launch.actions", "GroupAction",
        "actions, *, scoped=True, forwarding=True, launch_configurations=None, condition=None",
    ),
    "1.3 IncludeLaunchDescription": (
        "launch.actions", "IncludeLaunchDescription",
        "launch_description_source, *, launch_arguments=None, condition=None",
    ),
    "1.3 LogInfo": ("launch.actions", "LogInfo", "*, msg, condition=None"),
    "1.3 OpaqueCoroutine": (
        "launch.actions", "OpaqueCoroutine",
        "*, coroutine, args=None, kwargs=None, ignore_context=False, condition=None",
    ),
    "1.3 OpaqueFunction": (
        "launch.actions", "OpaqueFunction", "*, function, args=None, kwargs=None, condition=None",
    ),
    "1.3 PopEnvironment": ("launch.actions", "PopEnvironment", "*, condition=None"),
    "1.3 PopLaunchConfigurations": ("launch.actions", "PopLaunchConfigurations", "*, condition=None"),
    "1.3 PushEnvironment": ("launch.actions", "PushEnvironment", "*, condition=None"),
    "1.3 PushLaunchConfigurations": ("launch.actions", "PushLaunchConfigurations", "*, condition=None"),
    "1.3 RegisterEventHandler": ("launch.actions", "RegisterEventHandler", "event_handler, *, condition=None"),
    "1.3 ResetEnvironment": ("launch.actions", "ResetEnvironment", "*, condition=None"),
    "1.3 ResetLaunchConfigurations": (
        "launch.actions", "ResetLaunchConfigurations", "launch_configurations=None, *, condition=None",
    ),
    "1.3 SetEnvironmentVariable": ("launch.actions", "SetEnvironmentVariable", "name, value, *, condition=None"),
    "1.3 SetLaunchConfiguration": ("launch.actions", "SetLaunchConfiguration", "name, value, *, condition=None"),
    "1.3 Shutdown": ("launch.actions", "Shutdown", "*, reason='reason not given', condition=None"),
    "1.3 TimerAction": (
        "launch.actions", "TimerAction", "*, period, actions, cancel_on_shutdown=True, condition=None",
    ),
    "1.3 UnregisterEventHandler": ("launch.actions", "UnregisterEventHandler", "event_handler, *, condition=None"),
    "1.3 UnsetEnvironmentVariable": ("launch.actions", "UnsetEnvironmentVariable", "name, *, condition=None"),
    "1.3 UnsetLaunchConfiguration": ("launch.actions", "UnsetLaunchConfiguration", "name, *, condition=None"),
    "1.3.2 Executable": ("launch.descriptions", "Executable", f"*, cmd, {_PROGRAM}, arguments=None"),
    "1.4 TextSubstitution": ("launch.substitutions", "TextSubstitution", "*, text"),
    "1.4 LaunchConfiguration": ("launch.substitutions", "LaunchConfiguration", "variable_name, *, default=None"),
    "1.4 EnvironmentVariable": ("launch.substitutions", "EnvironmentVariable", "name, *, default_value=None"),
    "1.4 PathJoinSubstitution": ("launch.substitutions", "PathJoinSubstitution", "substitutions"),
    "1.4 PythonExpression": (
        "launch.substitutions", "PythonExpression", "expression, python_modules=ANY",
    ),
    "1.4 LocalSubstitution": ("launch.substitutions", "LocalSubstitution", "expression, description=None"),
    "1.4 FindExecutable": ("launch.substitutions", "FindExecutable", "*, name"),
    "1.4 Command": ("launch.substitutions", "Command", "command, *, on_stderr='fail'"),
    "1.4 FileContent": ("launch.substitutions", "FileContent", "path"),
    "1.4 ThisLaunchFile": ("launch.substitutions", "ThisLaunchFile", ""),
    "1.4 ThisLaunchFileDir": ("launch.substitutions", "ThisLaunchFileDir", ""),
    "1.4 LaunchLogDir": ("launch.substitutions", "LaunchLogDir", ""),
    "1.4 AnonName": ("launch.substitutions", "AnonName", "name"),
    "1.4 NotSubstitution": ("launch.substitutions", "NotSubstitution", "value"),
    "1.4 AndSubstitution": ("launch.substitutions", "AndSubstitution", "left, right"),
    "1.4 AndSubstitution, or": ("launch.substitutions", "OrSubstitution", "left, right"),
    "1.4 AnySubstitution": ("launch.substitutions", "AnySubstitution", "*args"),
    "1.4 AnySubstitution, all": ("launch.substitutions", "AllSubstitution", "*args"),
    "1.4 EqualsSubstitution": ("launch.substitutions", "EqualsSubstitution", "left, right"),
    "1.4 EqualsSubstitution, not": ("launch.substitutions", "NotEqualsSubstitution", "left, right"),
    "1.4 IfElseSubstitution": (
        "launch.substitutions", "IfElseSubstitution", "condition, if_value='', else_value=''",
    ),
    "1.5 IfCondition": ("launch.conditions", "IfCondition", "predicate_expression"),
    "1.5 UnlessCondition": ("launch.conditions", "UnlessCondition", "predicate_expression"),
    "1.5 LaunchConfigurationEquals": (
        "launch.conditions", "LaunchConfigurationEquals", "launch_configuration_name, expected_value",
    ),
    "1.5 LaunchConfigurationNotEquals": (
        "launch.conditions", "LaunchConfigurationNotEquals", "launch_configuration_name, expected_value",
    ),
    "1.5 evaluate_condition_expression": (
        "launch.conditions", "evaluate_condition_expression", "context, expression",
    ),
    "1.6 ExecutionComplete": ("launch.events", "ExecutionComplete", "*, action"),
    "1.6 IncludeLaunchDescription": ("launch.events", "IncludeLaunchDescription", "launch_description"),
    "1.6 Shutdown": ("launch.events", "Shutdown", "*, reason='reason not given', due_to_sigint=False"),
    "1.6 TimerEvent": ("launch.events", "TimerEvent", "*, timer_action"),
    "1.6 matches_action": ("launch.events", "matches_action", "target_action"),
    "1.6 process.RunningProcessEvent": ("launch.events.process", "RunningProcessEvent", f"*, {_RUNNING}"),
    "1.6 process.ProcessStarted": ("launch.events.process", "ProcessStarted", f"*, {_RUNNING}"),
    "1.6 process.ProcessExited": ("launch.events.process", "ProcessExited", f"*, returncode, {_RUNNING}"),
    "1.6 process.ProcessIO": ("launch.events.process", "ProcessIO", f"*, text, fd, {_RUNNING}"),
    "1.6 process.ProcessStdin": ("launch.events.process", "ProcessStdin", f"*, text, {_RUNNING}"),
    "1.6 process.ProcessStdout": ("launch.events.process", "ProcessStdout", f"*, text, {_RUNNING}"),
    "1.6 process.ProcessStderr": ("launch.events.process", "ProcessStderr", f"*, text, {_RUNNING}"),
    "1.6 process.ProcessTargetedEvent": ("launch.events.process", "ProcessTargetedEvent", "*, process_matcher"),
    "1.6 process.ShutdownProcess": ("launch.events.process", "ShutdownProcess", "*, process_matcher"),
    "1.6 process.SignalProcess": ("launch.events.process", "SignalProcess", "*, signal_number, process_matcher"),
    "1.6 process.matches_pid": ("launch.events.process", "matches_pid", "pid"),
    "1.6 process.matches_name": ("launch.events.process", "matches_name", "name"),
    "1.6 process.matches_executable": ("launch.events.process", "matches_executable", "executable"),
    "1.7 BaseEventHandler": ("launch.event_handler", "BaseEventHandler", f"*, matcher, {_HANDLER}"),
    "1.7 EventHandler": ("launch", "EventHandler", f"*, matcher, entities=None, {_HANDLER}"),
    "1.7 OnActionEventBase": (
        "launch.event_handlers.on_action_event_base", "OnActionEventBase",
        f"*, action_matcher, on_event, target_event_cls, target_action_cls, {_HANDLER}",
    ),
    "1.7 OnExecutionComplete": (
        "launch.event_handlers", "OnExecutionComplete", f"*, target_action=None, on_completion, {_HANDLER}",
    ),
    "1.7 OnProcessStart": (
        "launch.event_handlers", "OnProcessStart", f"*, target_action=None, on_start, {_HANDLER}",
    ),
    "1.7 OnProcessExit": (
        "launch.event_handlers", "OnProcessExit", f"*, target_action=None, on_exit, {_HANDLER}",
    ),
    "1.7 OnProcessIO": (
        "launch.event_handlers", "OnProcessIO",
        f"*, target_action=None, on_stdin=None, on_stdout=None, on_stderr=None, {_HANDLER}",
    ),
    "1.7 OnShutdown": ("launch.event_handlers", "OnShutdown", f"*, on_shutdown, {_HANDLER}"),
    "1.7 OnIncludeLaunchDescription": ("launch.event_handlers", "OnIncludeLaunchDescription", f"*, {_HANDLER}"),
    "1.7 event_named": ("launch.event_handlers", "event_named", "name"),
    "1.8 PythonLaunchDescriptionSource": (
        "launch.launch_description_sources", "PythonLaunchDescriptionSource", "launch_file_path",
    ),
    "1.8 AnyLaunchDescriptionSource": (
        "launch.launch_description_sources", "AnyLaunchDescriptionSource", "launch_file_path",
    ),
    "1.8 FrontendLaunchDescriptionSource": (
        "launch.launch_description_sources", "FrontendLaunchDescriptionSource",
        "launch_file_path, *, method='interpreted frontend launch file', parser=ANY",
    ),
    "1.8 XMLLaunchDescriptionSource": (
        "launch_xml.launch_description_sources", "XMLLaunchDescriptionSource", "launch_file_path",
    ),
    "1.8 YAMLLaunchDescriptionSource": (
        "launch_yaml.launch_description_sources", "YAMLLaunchDescriptionSource", "launch_file_path",
    ),
    "1.8 get_launch_description_from_any_launch_file": (
        "launch.launch_description_sources", "get_launch_description_from_any_launch_file",
        "launch_file_path, *, parser=ANY",
    ),
    "1.8 get_launch_description_from_any_launch_file, Python": (
        "launch.launch_description_sources", "get_launch_description_from_python_launch_file",
        "python_launch_file_path",
    ),
    "1.8 get_launch_description_from_any_launch_file, front ends": (
        "launch.launch_description_sources", "get_launch_description_from_frontend_launch_file",
        "frontend_launch_file_path, *, parser=ANY",
    ),
    "1.8 load_python_launch_file_as_module": (
        "launch.launch_description_sources", "load_python_launch_file_as_module", "python_launch_file_path",
    ),
    "1.9 normalize_to_list_of_substitutions": (
        "launch.utilities", "normalize_to_list_of_substitutions", "subs",
    ),
    "1.9 perform_substitutions": ("launch.utilities", "perform_substitutions", "context, subs"),
    "1.9 normalize_to_list_of_entities": ("launch.utilities", "normalize_to_list_of_entities", "entities"),
    "1.9 ensure_argument_type": (
        "launch.utilities", "ensure_argument_type", "argument, types, argument_name, caller=None",
    ),
    "1.9 is_a": ("launch.utilities", "is_a", "obj, entity_type"),
    "1.9 visit_all_entities_and_collect_futures": (
        "launch.utilities", "visit_all_entities_and_collect_futures", "entity, context",
    ),
    "1.9 AsyncSafeSignalManager": ("launch.utilities", "AsyncSafeSignalManager", "loop"),
    "1.9 type_utils.coerce_to_type": (
        "launch.utilities.type_utils", "coerce_to_type", "value, data_type=None, *, can_be_str=False",
    ),
    "1.9 type_utils, coerce_list": (
        "launch.utilities.type_utils", "coerce_list", "value, data_type=None, *, can_be_str=False",
    ),
    "1.9 type_utils, get_typed_value": (
        "launch.utilities.type_utils", "get_typed_value", "value, data_type, *, can_be_str=False",
    ),
    "1.9 type_utils, is_instance_of": (
        "launch.utilities.type_utils", "is_instance_of", "value, data_type=None, *, can_be_str=False",
    ),
    "1.9 type_utils, perform": (
        "launch.utilities.type_utils", "perform_typed_substitution", "context, value, data_type",
    ),
    "1.10 expose_action": ("launch.frontend", "expose_action", "name"),
    "1.10 expose_substitution": ("launch.frontend", "expose_substitution", "name"),
    "1.10 Entity": (
        "launch.frontend", "Entity.get_attr", "self, name, *, data_type=str, optional=False, can_be_str=True",
    ),
    "1.10 parse_substitution": ("launch.frontend.parse_substitution", "parse_substitution", "text"),
    "1.10 type_utils": ("launch.frontend.type_utils", "get_data_type_from_identifier", "type_identifier"),
    "1.10 type_utils, lists": ("launch.frontend.type_utils", "check_is_list_entity", "data_type"),
    "1.11 get_logger": ("launch.logging", "get_logger", "name=None"),
    "1.11 get_output_loggers": ("launch.logging", "get_output_loggers", "process_name, output_config"),
    "1.11 log_launch_config": ("launch.logging", "log_launch_config", "*, logger=ANY"),
    "1.12 Node": (
        "launch_ros.actions", "Node", f"*, executable, package=None, name=None, namespace=None, {_NODE}",
    ),
    "1.12 LifecycleNode": (
        "launch_ros.actions", "LifecycleNode", f"*, name, namespace, executable, package=None, {_NODE}",
    ),
    "1.12 ComposableNodeContainer": (
        "launch_ros.actions", "ComposableNodeContainer",
        f"*, name, namespace, composable_node_descriptions=None, executable, package=None, {_NODE}",
    ),
    "1.12 LoadComposableNodes": (
        "launch_ros.actions", "LoadComposableNodes",
        "*, composable_node_descriptions, target_container, condition=None",
    ),
    "1.12 PushROSNamespace": ("launch_ros.actions", "PushROSNamespace", "namespace, *, condition=None"),
    "1.12 SetParameter": ("launch_ros.actions", "SetParameter", "name, value, *, condition=None"),
    "1.12 SetParametersFromFile": ("launch_ros.actions", "SetParametersFromFile", "filename, *, condition=None"),
    "1.12 SetRemap": ("launch_ros.actions", "SetRemap", "src, dst, *, condition=None"),
    "1.12 SetROSLogDir": ("launch_ros.actions", "SetROSLogDir", "new_log_dir, *, condition=None"),
    "1.12 SetUseSimTime": ("launch_ros.actions", "SetUseSimTime", "value, *, condition=None"),
    "1.12 ROSTimer": ("launch_ros.actions", "ROSTimer", "*, period, actions, condition=None"),
    "1.12 LifecycleTransition": (
        "launch_ros.actions", "LifecycleTransition", "*, lifecycle_node_names, transition_ids, condition=None",
    ),
    "1.13 ComposableNode": (
        "launch_ros.descriptions", "ComposableNode",
        "*, package, plugin, name=None, namespace=None, parameters=None, remappings=None, extra_arguments=None, "
        "condition=None",
    ),
    "1.13 ParameterValue": ("launch_ros.parameter_descriptions", "ParameterValue", "value, *, value_type=None"),
    "1.13 Parameter": ("launch_ros.parameter_descriptions", "Parameter", "name, value, *, value_type=None"),
    "1.13 ParameterFile": (
        "launch_ros.parameter_descriptions", "ParameterFile", "param_file, *, allow_substs=False",
    ),
    "1.14 FindPackage": ("launch_ros.substitutions", "FindPackage", "package"),
    "1.14 FindPackagePrefix": ("launch_ros.substitutions", "FindPackagePrefix", "package"),
    "1.14 FindPackageShare": ("launch_ros.substitutions", "FindPackageShare", "package"),
    "1.14 ExecutableInPackage": ("launch_ros.substitutions", "ExecutableInPackage", "executable, package"),
    "1.14 Parameter": ("launch_ros.substitutions", "Parameter", "name, *, default=None"),
    "1.15 events.lifecycle.ChangeState": (
        "launch_ros.events.lifecycle", "ChangeState", "*, lifecycle_node_matcher, transition_id",
    ),
    "1.15 events.lifecycle.StateTransition": ("launch_ros.events.lifecycle", "StateTransition", "*, action, msg"),
    "1.15 events.matches_node_name": ("launch_ros.events", "matches_node_name", "node_name"),
    "1.15 events.lifecycle.matches_node_name": (
        "launch_ros.events.lifecycle", "matches_node_name", "node_name",
    ),
    "1.15 event_handlers.OnStateTransition": (
        "launch_ros.event_handlers", "OnStateTransition",
        "*, entities, target_lifecycle_node=None, transition=None, start_state=None, goal_state=None, matcher=None, "
        f"{_HANDLER}",
    ),
    "1.16 normalize_parameters": ("launch_ros.utilities", "normalize_parameters", "parameters"),
    "1.16 normalize_parameters, evaluate": ("launch_ros.utilities", "evaluate_parameters", "context, parameters"),
    "1.16 normalize_parameters, dict": ("launch_ros.utilities", "normalize_parameter_dict", "parameters"),
    "1.16 normalize_parameters, evaluate dict": (
        "launch_ros.utilities", "evaluate_parameter_dict", "context, parameters",
    ),
    "1.16 normalize_remap_rules": ("launch_ros.utilities", "normalize_remap_rules", "remap_rules"),
    "1.16 normalize_remap_rules, one": ("launch_ros.utilities", "normalize_remap_rule", "remap_rule"),
    "1.16 prefix_namespace": ("launch_ros.utilities", "prefix_namespace", "base_ns, ns"),
    "1.16 prefix_namespace, absolute": ("launch_ros.utilities", "make_namespace_absolute", "ns"),
    "1.16 add_node_name": ("launch_ros.utilities", "add_node_name", "context, node_name"),
    "1.16 add_node_name, count": ("launch_ros.utilities", "get_node_name_count", "context, node_name"),
    "1.16 to_parameters_list": (
        "launch_ros.utilities", "to_parameters_list", "context, node_name, namespace, evaluated_parameters",
    ),
    "1.17 get_package_prefix": ("ament_index_python", "get_package_prefix", "package_name"),
    "1.17 get_package_share_directory": (
        "ament_index_python.packages", "get_package_share_directory", "package_name, print_warning=True",
    ),
    "1.17 get_package_share_path": (
        "ament_index_python", "get_package_share_path", "package_name, print_warning=True",
    ),
    "1.17 get_packages_with_prefixes": ("ament_index_python", "get_packages_with_prefixes", ""),
    "1.17 get_search_paths": ("ament_index_python.search_paths", "get_search_paths", ""),
    "1.17 get_resource": ("ament_index_python.resources", "get_resource", "resource_type, resource_name"),
    "1.17 get_resource, several": ("ament_index_python", "get_resources", "resource_type"),
    "1.17 get_resource, any": ("ament_index_python", "has_resource", "resource_type, resource_name"),
}  # fmt: skip


def _expected(written: str) -> inspect.Signature:
    function: Any = eval(f"lambda {written}: None", {"ANY": _ANY})  # noqa: S307 - a text of this file
    return inspect.signature(function)


def _taken(target: Any) -> list[list[Parameter]]:
    """Return the parameters of a function, or of a constructor and then of those that it passes the rest on to."""
    if not inspect.isclass(target):
        return [list(inspect.signature(target).parameters.values())]
    constructors = [vars(kind)["__init__"] for kind in target.__mro__ if "__init__" in vars(kind)]
    return [list(inspect.signature(constructor).parameters.values())[1:] for constructor in constructors[:-1]]


def _is_needed(parameter: Parameter) -> bool:
    variable = (Parameter.VAR_KEYWORD, Parameter.VAR_POSITIONAL)
    return parameter.default is Parameter.empty and parameter.kind not in variable


@pytest.mark.parametrize("case", conforming(SIGNATURES))
def test_the_arguments_are_those_of_jazzy(case: str) -> None:
    module, name, written = SIGNATURES[case]
    target: Any = import_module(f"orchestra.compat.{module}")
    for part in name.split("."):
        target = getattr(target, part)
    chain = _taken(target)
    taken = {parameter.name: parameter for parameters in reversed(chain) for parameter in parameters}
    expected = _expected(written).parameters
    own = chain[0] if chain else []
    positional = [parameter.name for parameter in own if parameter.kind in _POSITIONAL]
    wanted = [parameter.name for parameter in expected.values() if parameter.kind in _POSITIONAL]
    assert positional[: len(wanted)] == wanted
    assert {parameter.name for parameter in own if _is_needed(parameter)} <= set(expected)
    for parameter in expected.values():
        if parameter.kind is Parameter.VAR_POSITIONAL:
            assert any(ours.kind is parameter.kind for ours in own)
            continue
        ours = taken[parameter.name]
        assert _is_needed(ours) is (_is_needed(parameter) and parameter.name != _STARTED.get(name))
        assert parameter.default in (_ANY, Parameter.empty) or ours.default == parameter.default


@pytest.mark.parametrize("name", _STARTED)
def test_a_node_without_anything_to_start_is_refused_as_by_python(name: str) -> None:
    made: Any = getattr(import_module("orchestra.compat.launch_ros.actions"), name)
    with pytest.raises(TypeError, match="missing 1 required keyword-only argument: 'executable'"):
        made(name="a", namespace="")

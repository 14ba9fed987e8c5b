"""One description as data, written in Python as people write it: with objects instead of `$(...)`."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

from orchestra.description.text import Call, Template, Words
from orchestra.errors import Problems
from orchestra.load.grammar import parse_template
from orchestra.location import point

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

Content = dict[str, Any]

_HEAD = """\
from typing import List

from launch import LaunchDescription
from launch.actions import *
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import *
from launch_ros.parameter_descriptions import ParameterFile, ParameterValue

Text = TextSubstitution
"""
_WORD = re.compile(r"(?:\$\((?:[^()]|\$\([^()]*\))*\)|\S)+")
_CALLS = {
    "equals": "EqualsSubstitution",
    "if": "IfElseSubstitution",
    "not": "NotSubstitution",
}
_DEFAULTS = {"var": ("LaunchConfiguration", "default"), "env": ("EnvironmentVariable", "default_value")}
# Keys whose values are texts, and their keyword in Python.
_TEXTS = {
    "cwd": "cwd",
    "exec_name": "exec_name",
    "launch-prefix": "prefix",
    "name": "name",
    "namespace": "namespace",
    "output": "output",
    "sigkill_timeout": "sigkill_timeout",
    "sigterm_timeout": "sigterm_timeout",
}
_PLAIN = {
    "shell": "shell",
    "respawn": "respawn",
    "respawn_delay": "respawn_delay",
    "respawn_max_retries": "respawn_max_retries",
    "autostart": "autostart",
}
_EXTENSIONS = (
    "alive",
    "depends_on",
    "for_each",
    "label",
    "lifecycle",
    "limits",
    "params_schema",
    "ready",
    "required",
    "restart",
    "scoped",
    "stdin",
    "stop",
    "success_exit_codes",
)


def as_python(actions: list[dict[str, Any]]) -> str:
    """Return a launch file."""
    body = f"    return LaunchDescription([\n        {_actions(actions)}\n    ])\n"
    return f"{_HEAD}\n\ndef generate_launch_description():\n{body}"


def _actions(actions: list[dict[str, Any]]) -> str:
    return ",\n        ".join(
        _WRITERS[name](content or {}) for action in actions for name, content in action.items()
    )


def text(value: Any) -> str:
    """Return the expression for a text of a file in YAML, for a number or a truth value that of its text."""
    if not isinstance(value, str):
        return repr(json.dumps(value))
    problems = Problems()
    template = parse_template(value, lambda *_: point("x"), problems)
    assert not problems.errors, (value, list(problems))
    return _template(template)


def _template(template: Template) -> str:
    parts = [_part(part) for part in template.parts]
    if not parts:
        return "''"
    return parts[0] if len(parts) == 1 else f"[{', '.join(parts)}]"


def _part(part: Any) -> str:
    if isinstance(part, Words):
        return repr(part.text)
    assert isinstance(part, Call)
    arguments = [_template(argument) for argument in part.arguments]
    if part.name in _CALLS:
        return f"{_CALLS[part.name]}({', '.join(arguments)})"
    name, keyword = _DEFAULTS[part.name]
    return f"{name}({f', {keyword}='.join(arguments)})"


def _value(value: Any) -> str:
    """Return the expression for a value that has its type: a text with substitutions is one all the same."""
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    return text(value) if isinstance(value, str) else repr(value)


def _looked_at(value: Any) -> str:
    """Return the expression for a value that is read by its looks where it is a text: Python does so for objects."""
    if not isinstance(value, str):
        return _value(value)
    expression = text(value)
    if "$(" in value:
        return expression
    return f"[Text(text={expression})]"


def _pairs(pairs: list[Content], key: str = "name", other: str = "value") -> str:
    return f"{{{', '.join(f'{text(pair[key])}: {text(pair[other])}' for pair in pairs)}}}"


def _parameters(params: list[Content]) -> str:
    return f"[{', '.join(map(_parameter, params))}]"


def _parameter(param: Content) -> str:
    if "from" in param:
        return f"ParameterFile({text(param['from'])}, allow_substs={param.get('allow_substs', False)})"
    name = text(param["name"])
    if "param" in param:
        inner = ", ".join(_parameter(item)[1:-1] for item in param["param"])
        return f"{{{name}: {{{inner}}}}}"
    value = _value(param["value"])
    if "type" in param:
        kind, _, items = param["type"].replace("yaml", "None").partition("list_of_")
        value = f"ParameterValue({value}, value_type={kind or f'List[{items}]'})"
    return f"{{{name}: {value}}}"


def _rules(rules: list[Content]) -> str:
    pairs = (f"({text(rule['from'])}, {text(rule['to'])})" for rule in rules)
    return f"[{', '.join(pairs)}]"


def _condition(content: Content) -> dict[str, str]:
    for key, kind in (("if", "IfCondition"), ("unless", "UnlessCondition")):
        if key in content:
            return {"condition": f"{kind}({text(content[key])})"}
    return {}


def _running(content: Content) -> dict[str, str]:
    found = {_TEXTS[key]: text(value) for key, value in content.items() if key in _TEXTS}
    found |= {_PLAIN[key]: _flag(value) for key, value in content.items() if key in _PLAIN}
    found |= {key: _extension(content[key]) for key in _EXTENSIONS if key in content}
    if "env" in content:
        found["additional_env"] = _pairs(content["env"])
    return found | _condition(content)


def _flag(value: Any) -> str:
    return text(value) if isinstance(value, str) else repr(value)


def _extension(value: Any) -> str:
    if isinstance(value, dict):
        return f"{{{', '.join(f'{key!r}: {_extension(item)}' for key, item in value.items())}}}"
    return f"[{', '.join(map(_extension, value))}]" if isinstance(value, list) else _flag(value)


def _node(content: Content) -> dict[str, str]:
    found = {"executable": text(content["exec"])} | _running(content)
    if "pkg" in content:
        found["package"] = text(content["pkg"])
    if "args" in content:
        found["arguments"] = f"[{', '.join(map(text, _WORD.findall(content['args']) or ['']))}]"
    return found | _settings(content)


def _settings(content: Content) -> dict[str, str]:
    found = {}
    if "param" in content:
        found["parameters"] = _parameters(content["param"])
    if "remap" in content:
        found["remappings"] = _rules(content["remap"])
    return found


def _components(components: list[Content]) -> str:
    return f"[{', '.join(map(_component, components))}]"


def _component(content: Content) -> str:
    found = {"package": text(content["pkg"]), "plugin": text(content["plugin"])}
    found |= {key: text(content[key]) for key in ("name", "namespace") if key in content}
    found |= _settings(content) | _condition(content)
    if "extra_arg" in content:
        pairs = (f"{{{text(item['name'])}: {_looked_at(item['value'])}}}" for item in content["extra_arg"])
        found["extra_arguments"] = f"[{', '.join(pairs)}]"
    return _call("ComposableNode", found)


def _call(name: str, keywords: Mapping[str, str]) -> str:
    return f"{name}({', '.join(f'{key}={value}' for key, value in keywords.items())})"


def _simple(name: str, /, **keywords: str) -> Callable[[Content], str]:
    """Return a writer of an action whose values are texts; `keywords` are Python's words for the keys."""

    def write(content: Content) -> str:
        found = {keywords[key]: text(value) for key, value in content.items() if key in keywords}
        return _call(name, found | _condition(content))

    return write


def _arg(content: Content) -> str:
    found = {"name": text(content["name"]), "default_value": text(content["default"])}
    if "choices" in content:
        found["choices"] = repr(content["choices"])
    return _call("DeclareLaunchArgument", found | _condition(content))


def _append_env(content: Content) -> str:
    found: dict[str, str] = {
        key: text(content[key]) for key in ("name", "value", "separator") if key in content
    }
    found |= {"prepend": _flag(content["prepend"])} if "prepend" in content else {}
    return _call("AppendEnvironmentVariable", found | _condition(content))


def _reset(content: Content) -> str:
    keep = {"launch_configurations": _pairs(content["keep"])} if "keep" in content else {}
    return _call("ResetLaunchConfigurations", keep | _condition(content))


def _set_parameter(content: Content) -> str:
    found = {"name": text(content["name"]), "value": _looked_at(content["value"])}
    return _call("SetParameter", found | _condition(content))


def _executable(content: Content) -> str:
    words = content["cmd"] if isinstance(content["cmd"], list) else _COMMANDS[content["cmd"]]
    return _call("ExecuteProcess", {"cmd": f"[{', '.join(map(text, words))}]"} | _running(content))


# Commands that tests write as a text, in words.
_COMMANDS = {
    "prog": ["prog"],
    "prog 'a b' c": ["prog", "a b", "c"],
    "prog x$(var a 'y z')": ["prog", "x$(var a 'y z')"],
}


def _container(content: Content) -> str:
    components = (
        {"composable_node_descriptions": _components(content["composable_node"])}
        if "composable_node" in content
        else {}
    )
    return _call("ComposableNodeContainer", _node(content) | components)


def _load(content: Content) -> str:
    found = {
        "target_container": text(content["target"]),
        "composable_node_descriptions": _components(content["composable_node"]),
    }
    return _call("LoadComposableNodes", found | _condition(content))


def _group(content: Content) -> str:
    found = {"actions": f"[{_actions(content['children'])}]"}
    found |= {key: repr(content[key]) for key in ("scoped", "forwarding") if key in content}
    found |= {"launch_configurations": _pairs(content["keep"])} if "keep" in content else {}
    found |= {"for_each": _extension(content["for_each"])} if "for_each" in content else {}
    return _call("GroupAction", found | _condition(content))


def _include(content: Content) -> str:
    found = {key: _extension(content[key]) for key in _EXTENSIONS if key in content}
    if "arg" in content:
        found["launch_arguments"] = f"{_pairs(content['arg'])}.items()"
    keywords = "".join(f", {key}={value}" for key, value in (found | _condition(content)).items())
    return f"IncludeLaunchDescription({text(content['file'])}{keywords})"


def _timer(name: str) -> Callable[[Content], str]:
    def write(content: Content) -> str:
        period = content["period"]  # ROS 2 takes no whole number
        found = {
            "period": _flag(float(period) if isinstance(period, int) else period),
            "actions": f"[{_actions(content['children'])}]",
        }
        return _call(name, found | _condition(content))

    return write


_WRITERS: Mapping[str, Callable[[Content], str]] = {
    "append_env": _append_env,
    "arg": _arg,
    "executable": _executable,
    "group": _group,
    "include": _include,
    "let": _simple("SetLaunchConfiguration", name="name", value="value"),
    "lifecycle_node": lambda content: _call("LifecycleNode", _node(content)),
    "load_composable_node": _load,
    "log": _simple("LogInfo", message="msg"),
    "node": lambda content: _call("Node", _node(content)),
    "node_container": _container,
    "push_ros_namespace": _simple("PushRosNamespace", namespace="namespace"),
    "reset": _reset,
    "reset_env": _simple("ResetEnvironment"),
    "ros_timer": _timer("RosTimer"),
    "set_env": _simple("SetEnvironmentVariable", name="name", value="value"),
    "set_parameter": _set_parameter,
    "set_parameters_from_file": _simple("SetParametersFromFile", filename="filename"),
    "set_remap": _simple("SetRemap", **{"from": "src", "to": "dst"}),
    "set_ros_log_dir": _simple("SetROSLogDir", new_log_dir="new_log_dir"),
    "shutdown": _simple("Shutdown", reason="reason"),
    "timer": _timer("TimerAction"),
    "unset_env": _simple("UnsetEnvironmentVariable", name="name"),
}

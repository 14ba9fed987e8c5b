"""Every form in which one parameter of one node can be written, from its value."""

from __future__ import annotations

import math
import re
import sys
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from tests.load.written import attribute

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.values import ParameterValue, Scalar

NODE = "/ns/n"
_FILE = "given.yaml"
_HEAD = """\
from typing import List
from launch import LaunchDescription
from launch.actions import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import *
from launch_ros.parameter_descriptions import ParameterFile, ParameterValue

"""


@dataclass(frozen=True)
class Written:
    """A launch file, the files beside it, and the words after it."""

    name: str
    text: str
    beside: dict[str, str] = field(default_factory=dict)
    words: tuple[str, ...] = ()
    params_files: tuple[str, ...] = ()


def type_word(value: ParameterValue) -> str:
    """Return the word for the type of a value in the launch language."""
    if isinstance(value, tuple):
        return f"list_of_{type(value[0]).__name__}"
    return type(value).__name__


def yaml_text(value: ParameterValue) -> str:
    """Return a value in YAML, texts in quotes."""
    if isinstance(value, tuple):
        return f"[{', '.join(map(_scalar, value))}]"
    return _scalar(value)


def _scalar(value: Scalar) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        if not math.isfinite(value):
            return {"inf": ".inf", "-inf": "-.inf", "nan": ".nan"}[repr(value)]
        if 0 < abs(value) < sys.float_info.min:
            return value.hex()  # rcl takes an inexact number below the normal ones for a text
        mantissa, exponent, power = repr(value).partition("e")
        return f"{mantissa}{'' if '.' in mantissa else '.0'}{exponent}{power}"
    return _quoted(value) if isinstance(value, str) else repr(value)


def _quoted(text: str) -> str:
    """Return a text in double quotes: whatever YAML may not have is escaped."""
    return '"' + re.sub(r'["\\]|[^ -~\u00a0-\ud7ff]', _escape, text) + '"'


def _escape(found: re.Match[str]) -> str:
    return f"\\{found[0]}" if found[0] in '"\\' else f"\\U{ord(found[0]):08X}"


def python_text(value: ParameterValue) -> str:
    """Return the expression for a value in Python."""
    if isinstance(value, tuple):
        return f"[{', '.join(map(python_text, value))}]"
    if isinstance(value, float) and not math.isfinite(value):
        return f"float({repr(value)!r})"
    return repr(value)


def _yaml(*before: str, param: str) -> str:
    actions = "".join(f"  - {action}\n" for action in before)
    return f"launch:\n{actions}  - node: {{exec: e, name: n, namespace: /ns, param: [{param}]}}\n"


def _xml(*before: str, param: str) -> str:
    node = f'<node exec="e" name="n" namespace="/ns">{param}</node>'
    return f'<?xml version="1.1"?>\n<launch>{"".join(before)}{node}</launch>\n'


def _python(*before: str, parameters: str) -> str:
    node = f"Node(executable='e', name='n', namespace='/ns', parameters=[{parameters}])"
    body = ", ".join((*before, node))
    return f"{_HEAD}\ndef generate_launch_description():\n    return LaunchDescription([{body}])\n"


def _file(value: ParameterValue) -> dict[str, str]:
    return {_FILE: f"{NODE}:\n  ros__parameters:\n    p: {yaml_text(value)}\n"}


def _escaped(text: str) -> str:
    """Return a text that has no substitution in it, as the launch language writes it."""
    return text.replace("\\", "\\\\").replace("$", "\\$")


def _template(value: ParameterValue) -> ParameterValue:
    if isinstance(value, tuple):
        return tuple(_escaped(item) for item in value if isinstance(item, str)) or value
    return _escaped(value) if isinstance(value, str) else value


def _as_rcl_reads(value: ParameterValue) -> str:
    """Return a value for an action that hands its text to rcl as it stands: quotes of YAML's own mean nothing there."""
    return _quoted(_escaped(yaml_text(value)))


def _plain(value: ParameterValue) -> str:
    """Return a value as the text that a type is given to."""
    return value if isinstance(value, str) else yaml_text(value)


def _xml_text(value: ParameterValue, *, typed: bool) -> str:
    text = _plain(value) if typed else yaml_text(value)
    return attribute(_escaped(text))


FORMS: dict[str, Callable[[ParameterValue], Written]] = {
    "yaml": lambda v: Written("a.yaml", _yaml(param=f"{{name: p, value: {yaml_text(_template(v))}}}")),
    "yaml typed": lambda v: Written(
        "a.yaml",
        _yaml(param=f"{{name: p, type: {type_word(v)}, value: {_quoted(_escaped(_plain(v)))}}}"),
    ),
    "yaml nested": lambda v: Written(
        "a.yaml",
        _yaml(param=f"{{name: a, param: [{{name: p, value: {yaml_text(_template(v))}}}]}}"),
    ),
    "yaml set_parameter": lambda v: Written(
        "a.yaml", _yaml(f"set_parameter: {{name: p, value: {_as_rcl_reads(v)}}}", param="")
    ),
    "yaml file": lambda v: Written("a.yaml", _yaml(param=f"{{from: {_FILE}}}"), _file(v)),
    "yaml file for all": lambda v: Written(
        "a.yaml", _yaml(f"set_parameters_from_file: {{filename: {_FILE}}}", param=""), _file(v)
    ),
    "xml typed": lambda v: Written(
        "a.launch.xml",
        _xml(param=f'<param name="p" type="{type_word(v)}" value="{_xml_text(v, typed=True)}"/>'),
    ),
    "xml quoted": lambda v: Written(
        "a.launch.xml", _xml(param=f'<param name="p" value="{_xml_text(v, typed=False)}"/>')
    ),
    "xml file": lambda v: Written("a.launch.xml", _xml(param=f'<param from="{_FILE}"/>'), _file(v)),
    "python": lambda v: Written("a.launch.py", _python(parameters=f"{{'p': {python_text(v)}}}")),
    "python tuple": lambda v: Written(
        "a.launch.py",
        _python(
            parameters=f"{{'p': {f'tuple({python_text(v)})' if isinstance(v, tuple) else python_text(v)}}}"
        ),
    ),
    "python typed": lambda v: Written(
        "a.launch.py",
        _python(parameters=f"{{'p': ParameterValue({python_text(v)}, value_type={_python_type(v)})}}"),
    ),
    "python nested": lambda v: Written(
        "a.launch.py", _python(parameters=f"{{'a': {{'p': {python_text(v)}}}}}")
    ),
    "python file": lambda v: Written(
        "a.launch.py",
        _python(parameters=f"ParameterFile([ThisLaunchFileDir(), '/{_FILE}'])"),
        _file(v),
    ),
    "python for all": lambda v: Written(
        "a.launch.py",
        _python(
            f"SetParameter('p', ParameterValue({python_text(v)}, value_type={_python_type(v)}))",
            parameters="",
        ),
    ),
    "command line": lambda v: Written("a.yaml", _yaml(param=""), words=(f"{NODE}:p:={yaml_text(v)}",)),
    "file of the command line": lambda v: Written("a.yaml", _yaml(param=""), _file(v), params_files=(_FILE,)),
}


def _python_type(value: ParameterValue) -> str:
    kind, _, items = type_word(value).partition("list_of_")
    return kind or f"List[{items}]"

"""Mistakes in Python launch files: each is told once, at its own place, in words that help.

`«` and `»` stand around the place that is to be told; they are no part of the file.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from textwrap import dedent, indent
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Problem, Problems
from orchestra.pipeline import collect, inputs_from

if TYPE_CHECKING:
    from pathlib import Path

_HEAD = """\
import os
from launch import *
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import *
from launch_ros.substitutions import *
TALKER = dict(package='demo', executable='talker')
"""
_NOTHING = "import launch as l\ndef generate_launch_description(): return l.LaunchDescription([])"
_INNER = "from launch import *\nfrom launch.actions import *\n"


@dataclass(frozen=True)
class Mistake:
    """A file, the body of its function, or its actions; what is said of it."""

    code: str
    message: str
    kind: Code = Code.USER_CODE
    suggestion: str | None = None
    note: str = ""


_CALLS = {
    "a text that is put together of an empty one and another": Mistake(
        "[DeclareLaunchArgument('mode', default_value='sim', choices=['sim', 'real']), LogInfo(msg='x', condition="
        "IfCondition(EqualsSubstitution(LaunchConfiguration('mode'), '' + '«rael»')))]",
        "'mode' is sim, real, not 'rael': this is never true",
        Code.IMPOSSIBLE_CONDITION,
        "real",
    ),
    "a keyword that nobody takes": Mistake(
        "[Node(package='demo', «exectuable»='talker')]",
        "Node has no argument 'exectuable'",
        Code.UNKNOWN_KEY,
        "executable",
    ),
    "a keyword of a class that the action derives from": Mistake(
        "[Node(**TALKER, «additionl_env»={'a': 'b'})]",
        "Node has no argument 'additionl_env'",
        Code.UNKNOWN_KEY,
        "additional_env",
    ),
    "a keyword of Orchestra's own": Mistake(
        "[Node(**TALKER, «requird»=True)]", "Node has no argument 'requird'", Code.UNKNOWN_KEY, "required"
    ),
    "a keyword out of a mapping": Mistake(
        "[Node(**{'package': 'demo', '«exectuable»': 'talker'}, executable='talker')]",
        "Node has no argument 'exectuable'",
        Code.UNKNOWN_KEY,
        "executable",
    ),
    "a keyword of a class of the file's own": Mistake(
        "class Talker(Node):\n    def __init__(self, **more):\n        super().__init__(**TALKER, **more)\n"
        "return LaunchDescription([Talker(«naem»='a')])",
        "Node has no argument 'naem'",
        Code.UNKNOWN_KEY,
        "name",
    ),
    "a keyword of a declaration": Mistake(
        "[DeclareLaunchArgument('a', «default»='x')]",
        "DeclareLaunchArgument has no argument 'default'",
        Code.UNKNOWN_KEY,
        "default_value",
    ),
    "a keyword of an event handler": Mistake(
        "[RegisterEventHandler(OnProcessExit(«target»=Node(**TALKER), on_exit=[]))]",
        "OnProcessExit has no argument 'target'",
        Code.UNKNOWN_KEY,
        "target_action",
    ),
    "a keyword that is needed": Mistake(
        "[«Node(package='demo')»]", "Node needs 'executable'", Code.MISSING_KEY
    ),
    "a keyword that a class needs which it derives from": Mistake(
        "[«ComposableNodeContainer(name='c', namespace='')»]",
        "ComposableNodeContainer needs 'executable'",
        Code.MISSING_KEY,
    ),
    "two keywords that are needed": Mistake(
        "[«LifecycleNode(**TALKER)»]", "LifecycleNode needs 'name' and 'namespace'", Code.MISSING_KEY
    ),
    "an argument without a name": Mistake(
        "[Node(«'demo', 'talker'»)]",
        "Node takes no arguments without a name",
        Code.WRONG_TYPE,
        suggestion="package='demo', executable='talker'",
        note="it is written Node(executable=..., package=...)",
    ),
    "two arguments instead of a list": Mistake(
        "return LaunchDescription(«Node(**TALKER), Node(**TALKER)»)",
        "LaunchDescription takes one list, not 2 arguments",
        Code.WRONG_TYPE,
        suggestion="[Node(**TALKER), Node(**TALKER)]",
    ),
}

_NAMES = {
    "a name that a package does not have": Mistake(
        f"from launch.actions import «ExecuteProces»\n{_NOTHING}",
        "launch.actions has no 'ExecuteProces'",
        suggestion="ExecuteProcess",
    ),
    "a name of several lines of names": Mistake(
        f"from launch.actions import (\n    LogInfo,\n    «GroupActon»,\n)\n{_NOTHING}",
        "launch.actions has no 'GroupActon'",
        suggestion="GroupAction",
    ),
    "a name that is in another package": Mistake(
        f"from launch_ros.actions import «ComposableNode»\n{_NOTHING}",
        "launch_ros.actions has no 'ComposableNode': it is in launch_ros.descriptions",
        suggestion="from launch_ros.descriptions import ComposableNode",
    ),
    "a module": Mistake(
        f"from «launch_ros.action» import Node\n{_NOTHING}",
        "there is no Python module 'launch_ros.action' here",
        suggestion="launch_ros.actions",
    ),
    "a package": Mistake(
        f"import «launch_rso»\n{_NOTHING}",
        "there is no Python module 'launch_rso' here",
        suggestion="launch_ros",
    ),
    "an attribute of a package": Mistake(
        "import launch\ndef generate_launch_description():\n    return launch.«LaunchDescripton»([])",
        "launch has no 'LaunchDescripton'",
        suggestion="LaunchDescription",
    ),
    "an attribute of an object": Mistake(
        "ld = LaunchDescription()\nld.«add_acton»(Node(**TALKER))\nreturn ld",
        "LaunchDescription has no attribute 'add_acton'",
        suggestion="add_action",
    ),
    "a name with a slip": Mistake(
        "[«Nod»(executable='a')]", "there is no name 'Nod' here", suggestion="Node"
    ),
    "a name that is not imported": Mistake(
        "from launch import LaunchDescription\ndef generate_launch_description():\n"
        "    return LaunchDescription([«Node»(executable='a')])",
        "there is no name 'Node' here",
        suggestion="from launch_ros.actions import Node",
    ),
}

_FUNCTION = {
    "no return": Mistake(
        "LaunchDescription([])\ndef generate_launch_description():\n    LaunchDescription([])",
        "generate_launch_description() returns nothing: its `return` is missing",
        Code.NO_DESCRIPTION,
        suggestion="return LaunchDescription",
    ),
    "a list": Mistake(
        "return [Node(**TALKER)]",
        "generate_launch_description() returns a LaunchDescription, not a list",
        Code.NO_DESCRIPTION,
        suggestion="LaunchDescription([Node(**TALKER)])",
        note="put it into LaunchDescription([...])",
    ),
    "an action": Mistake(
        "return Node(**TALKER)",
        "generate_launch_description() returns a LaunchDescription, not a Node",
        Code.NO_DESCRIPTION,
        suggestion="LaunchDescription([Node(**TALKER)])",
    ),
    "an argument": Mistake(
        "def «generate_launch_description»(context):\n    return LaunchDescription([])",
        "generate_launch_description is called without arguments",
        Code.WRONG_TYPE,
    ),
    "a slip in its name": Mistake(
        "def «generate_launch_descripton»():\n    return LaunchDescription([])",
        "has no function generate_launch_description()",
        Code.NO_DESCRIPTION,
        "generate_launch_description",
        note="it has generate_launch_descripton()",
    ),
}

_ENTITIES = {
    "a list among actions": Mistake(
        "[LogInfo(msg='a'), «[Node(**TALKER)]»]",
        "an action is expected here, this is a list",
        Code.WRONG_TYPE,
        suggestion="Node(**TALKER)",
        note="a * before it makes its items part of the list around it",
    ),
    "a class": Mistake(
        "[«Shutdown»]",
        "an action is expected here, this is the class Shutdown",
        Code.WRONG_TYPE,
        suggestion="Shutdown()",
        note="brackets after the class make an object of it",
    ),
    "an event handler": Mistake(
        "[«OnShutdown(on_shutdown=[])»]",
        "an action is expected here, this is an OnShutdown",
        Code.WRONG_TYPE,
        suggestion="RegisterEventHandler(OnShutdown(on_shutdown=[]))",
    ),
    "a source": Mistake(
        "[«PythonLaunchDescriptionSource('b.launch.py')»]",
        "an action is expected here, this is a PythonLaunchDescriptionSource",
        Code.WRONG_TYPE,
        suggestion="IncludeLaunchDescription(PythonLaunchDescriptionSource('b.launch.py'))",
    ),
    "a component": Mistake(
        "[GroupAction([LogInfo(msg='a'), «ComposableNode(package='demo', plugin='P')»])]",
        "an action is expected here, this is a ComposableNode",
        Code.WRONG_TYPE,
    ),
    "nothing, added later": Mistake(
        "ld = LaunchDescription()\nld.add_action(«None»)\nreturn ld",
        "an action is expected here, this is None",
        Code.WRONG_TYPE,
    ),
    "a text out of a function": Mistake(
        "def f(context):\n    return [«'a'»]\nreturn LaunchDescription([OpaqueFunction(function=f)])",
        "an action is expected here, this is 'a'",
        Code.WRONG_TYPE,
    ),
    "an action out of a function": Mistake(
        "def f(context):\n    return «Node(**TALKER)»\nreturn LaunchDescription([OpaqueFunction(function=f)])",
        "f returns a list of actions or None, this is a Node",
        Code.WRONG_TYPE,
        suggestion="[Node(**TALKER)]",
    ),
    "an action instead of a group's list": Mistake(
        "[GroupAction(«Node(**TALKER)»)]",
        "a list of actions is expected here, this is a Node",
        Code.WRONG_TYPE,
        suggestion="[Node(**TALKER)]",
    ),
    "a node among components": Mistake(
        "[LoadComposableNodes(target_container='/c', composable_node_descriptions=[«Node(**TALKER)»])]",
        "composable_node_descriptions are of the class ComposableNode, this is a Node",
        Code.WRONG_TYPE,
    ),
    "an action that does not begin as one": Mistake(
        "class Own(Action):\n    def __init__(self): pass\nreturn «LaunchDescription([Own()])»",
        "Own.__init__ does not call super().__init__()",
    ),
}

_VALUES = {
    "a truth value in a condition": Mistake(
        "[Node(**TALKER, condition=IfCondition(«True»))]",
        "expected a text or a substitution",
        Code.WRONG_TYPE,
        suggestion="'true'",
    ),
    "a truth value as a condition": Mistake(
        "[Node(**TALKER, condition=«True»)]",
        "a condition is made by IfCondition or UnlessCondition, this is True",
        Code.WRONG_TYPE,
        suggestion="IfCondition('true')",
    ),
    "a substitution as a component's condition": Mistake(
        "[LoadComposableNodes(target_container='/c', composable_node_descriptions=["
        "ComposableNode(package='demo', plugin='P', condition=«LaunchConfiguration('a')»)])]",
        "a condition is made by IfCondition or UnlessCondition, this is a LaunchConfiguration",
        Code.WRONG_TYPE,
        suggestion="IfCondition(LaunchConfiguration('a'))",
    ),
    "a remapping that is a list": Mistake(
        "[Node(**TALKER, remappings=[«['a', 'b']»])]",
        "a remapping is a tuple of two names, not ['a', 'b']",
        Code.WRONG_TYPE,
        suggestion="('a', 'b')",
    ),
    "parameters that are no list": Mistake(
        "[Node(**TALKER, parameters=«{'a': 1}»)]",
        "'parameters' of a Node is a list, not dict: {'a': 1}",
        Code.WRONG_TYPE,
        suggestion="[{'a': 1}]",
    ),
    "a parameter without a value": Mistake(
        "[Node(**TALKER, parameters=[{'a': «None»}])]",
        "parameter 'a': None is no value of a parameter",
        Code.WRONG_TYPE,
    ),
    "a parameter that no node can have": Mistake(
        "[Node(**TALKER, parameters=[{'a': {'b': [1, '«c»']}}])]",
        "parameter 'a.b': a list must hold values of one type, not 1 and 'c'",
        Code.PARAMETER_TYPE,
    ),
    "a text that looks like something else": Mistake(
        "[Node(**TALKER, parameters=[{'robot_description': «Command('echo \\'<robot name=\"a: b\"/>\\'')»}])]",
        "parameter 'robot_description': '<robot name=\"a: b\"/>' is a mapping",
        Code.PARAMETER_TYPE,
        note="ParameterValue(..., value_type=str) keeps it a text",
    ),
    "an environment that is a list": Mistake(
        "[Node(**TALKER, additional_env=«[('a', 'b')]»)]",
        "an environment is a dict of names and values, this is a list",
        Code.WRONG_TYPE,
        "{'a': 'b'}",
    ),
    "a variable that is a number": Mistake(
        "[Node(**TALKER, additional_env={'LEVEL': «5»})]",
        "the value of 'LEVEL' in an environment: expected a text or a substitution (or several in a list), found int",
        Code.WRONG_TYPE,
        "'5'",
    ),
    "a command that is one text": Mistake(
        "[ExecuteProcess(cmd=«'ls -l'»)]", "cmd is a list of words", Code.WRONG_TYPE, "['ls', '-l']"
    ),
    "an argument of an include that is one text": Mistake(
        "[IncludeLaunchDescription('inner.launch.py', launch_arguments=[«'a:=b'»])]",
        "a name and its value are expected, not 'a:=b'",
        Code.WRONG_TYPE,
    ),
    "an argument of an include that is a number": Mistake(
        "[IncludeLaunchDescription('inner.launch.py', launch_arguments={'a': «5»}.items())]",
        "a: expected a text or a substitution (or several in a list), found int: 5",
        Code.WRONG_TYPE,
        suggestion="'5'",
    ),
    "a substitution added to a text": Mistake(
        "[LogInfo(msg=«'a' + LaunchConfiguration('b')»)]",
        "LaunchConfiguration is no text before the launch file is visited",
        suggestion="['a', LaunchConfiguration('b')]",
        note="a list joins texts and substitutions: ['a', LaunchConfiguration('b')]",
    ),
    "a substitution in a path": Mistake(
        "[LogInfo(msg=os.path.join(«FindPackageShare('demo')», 'x'))]",
        "FindPackageShare is no text before the launch file is visited: PathJoinSubstitution joins the parts of a path",
        note="did you mean 'PathJoinSubstitution([FindPackageShare('demo'), 'x'])'?",
    ),
}

_THINGS = {
    "a name of a launch argument": Mistake(
        "[DeclareLaunchArgument('robot_name', default_value='a'), LogInfo(msg=LaunchConfiguration('«robot_nme»'))]",
        "no launch argument or variable 'robot_nme' is set here",
        Code.UNDEFINED_VARIABLE,
        "robot_name",
    ),
    "a name of a launch argument that is not written there": Mistake(
        "name = '«robot_nme»'\nreturn LaunchDescription([DeclareLaunchArgument('robot_name', default_value='a'), "
        "LogInfo(msg=LaunchConfiguration(name))])",
        "no launch argument or variable 'robot_nme' is set here",
        Code.UNDEFINED_VARIABLE,
        "robot_name",
    ),
    "a package": Mistake(
        "[Node(package='«demmo»', executable='talker')]",
        "there is no package 'demmo' here",
        Code.MISSING_PACKAGE,
        "demo",
    ),
    "an executable": Mistake(
        "[Node(package='demo', executable='«talkr»')]",
        "package 'demo' has no executable 'talkr'",
        Code.MISSING_EXECUTABLE,
        "talker",
    ),
    "a launch file": Mistake(
        "[IncludeLaunchDescription('«iner.launch.py»')]",
        "there is no launch file iner.launch.py",
        Code.MISSING_FILE,
        "inner.launch.py",
    ),
    "a folder instead of a parameter file": Mistake(
        "[Node(**TALKER, parameters=[«FindPackageShare('demo')»])]", ": it is a folder", Code.MISSING_FILE
    ),
    "an argument of an include": Mistake(
        "[IncludeLaunchDescription('inner.launch.py', launch_arguments={'«needde»': '1'}.items())]",
        "inner.launch.py has no argument 'needde'",
        Code.UNKNOWN_ARGUMENT,
        "needed",
    ),
    "a name of a transition": Mistake(
        "[LifecycleTransition(lifecycle_node_names=['a'], transition_ids=['«configure»'])]",
        "expected a whole number, found 'configure'",
        Code.WRONG_TYPE,
    ),
}


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the prefix of a package `demo` with a program; the working directory has a launch file to include."""
    prefix = tmp_path / "install"
    index = prefix / "share/ament_index/resource_index/packages"
    for folder in (index, prefix / "lib/demo", prefix / "share/demo"):
        folder.mkdir(parents=True)
    (index / "demo").touch()
    (prefix / "lib/demo/talker").write_text("#!/bin/sh\n", "utf-8")
    (prefix / "lib/demo/talker").chmod(0o755)
    inner = "def generate_launch_description():\n    return LaunchDescription([DeclareLaunchArgument('needed')])\n"
    (tmp_path / "inner.launch.py").write_text(_INNER + inner, "utf-8")
    monkeypatch.chdir(tmp_path)
    return prefix


_TABLES = {
    "calls": _CALLS,
    "names": _NAMES,
    "function": _FUNCTION,
    "entities": _ENTITIES,
    "values": _VALUES,
    "things": _THINGS,
}
_CASES = [
    pytest.param(case, id=f"{table}: {name}")
    for table, cases in _TABLES.items()
    for name, case in cases.items()
]


@pytest.mark.parametrize("mistake", _CASES)
def test_a_mistake_is_told_once_at_its_place(workspace: Path, mistake: Mistake) -> None:
    (problem,) = _problems(workspace, _file(mistake.code))
    assert mistake.message in problem.message
    assert (problem.code, problem.suggestion) == (mistake.kind, mistake.suggestion)
    assert mistake.note in (*problem.notes, "")
    assert "orchestra" not in f"{problem.message}{problem.notes}"
    assert " at 0x" not in problem.message
    assert problem.span is not None
    if "«" in mistake.code:
        begin, end = _marked(_file(mistake.code))
        span = problem.span
        assert ((span.line, span.column), (span.end_line, span.end_column)) == (begin, end)


def test_a_mistake_in_an_included_file_names_the_way_to_it(workspace: Path, tmp_path: Path) -> None:
    body = "def generate_launch_description():\n    return LaunchDescription([LogInfo(mgs='a')])\n"
    (tmp_path / "inner.launch.py").write_text(_INNER + body, "utf-8")
    (problem,) = _problems(workspace, _file("[IncludeLaunchDescription('inner.launch.py')]"))
    assert (str(problem.span), problem.suggestion) == ("inner.launch.py:4:39", "msg")
    assert [at.file for at in problem.included_from] == ["main.launch.py"]


def test_calls_on_the_way_are_told_once_each(workspace: Path) -> None:
    code = "def f(n):\n    return f(n - 1) if n else LogInfo(mgs='a')\nreturn LaunchDescription([f(20)])"
    (problem,) = _problems(workspace, _file(code))
    assert len(problem.notes) == 2


def _file(code: str) -> str:
    code = dedent(code)
    if code.startswith("["):
        code = f"return LaunchDescription({code})"
    if "def generate_launch_descrip" in re.sub("[«»]", "", code):
        return code if "launch_ros" in code or "import" in code else f"{_HEAD}{code}"
    return f"{_HEAD}def generate_launch_description():\n{indent(code, '    ')}\n"


def _problems(prefix: Path, code: str) -> tuple[Problem, ...]:
    with open("main.launch.py", "w", encoding="utf-8") as file:  # noqa: PTH123 - in the working directory
        file.write(re.sub("[«»]", "", code))
    problems = Problems()
    environment = {"PATH": "/usr/bin:/bin", "AMENT_PREFIX_PATH": str(prefix)}
    collect("main.launch.py", inputs_from([], environment=environment), problems)
    return problems.ordered


def _marked(code: str) -> tuple[tuple[int, int], tuple[int, int]]:
    """Return line and column of the begin and of the end of what is between the marks."""
    before, inside, _ = re.split("[«»]", code)
    return _place(before), _place(before + inside)


def _place(text: str) -> tuple[int, int]:
    return text.count("\n") + 1, len(text) - text.rfind("\n")

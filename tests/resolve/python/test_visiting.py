"""Python launch files, run and visited for real: order, scopes, user code, and what is wrong with it."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra import pipeline
from orchestra.errors import Code, Problems
from orchestra.plan.codec import encode

if TYPE_CHECKING:
    from orchestra.plan.model import Plan

HEAD = """\
import os, sys
from launch import Action, Condition, LaunchDescription, Substitution
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.events import Shutdown as ShutdownEvent
from launch.substitutions import *
from launch.launch_description_sources import *
"""


def planned(
    folder: Path, files: dict[str, str], *words: str, **environment: str
) -> tuple[Plan | None, Problems]:
    """Write launch files (the first is the one that is launched) and plan them."""
    for name, text in files.items():
        (folder / name).write_text(HEAD + text if name.endswith(".py") else text)
    problems = Problems()
    inputs = pipeline.inputs_from(words, environment={"PATH": os.environ["PATH"], **environment})
    return pipeline.collect(str(folder / next(iter(files))), inputs, problems), problems


def said(folder: Path, body: str, *words: str, **environment: str) -> list[str]:
    """Return what a launch file without faults says at its start; `body` are the entities of its description."""
    text = (
        body
        if "def generate" in body
        else f"def generate_launch_description():\n    return LaunchDescription([{body}])\n"
    )
    plan, problems = planned(folder, {"main.launch.py": text}, *words, **environment)
    assert not problems.errors, list(problems)
    assert plan is not None
    return messages(plan)


def messages(plan: Plan) -> list[str]:
    """Return what a plan logs at its start."""
    return [
        action.message
        for trigger in plan.triggers
        for action in trigger.do
        if action.action == "log" and trigger.on.event == "run_started"
    ]


def faults(folder: Path, text: str, *words: str) -> list[tuple[Code, int, str]]:
    """Return code, line (without the imports) and message of what is wrong with a launch file."""
    _, problems = planned(folder, {"main.launch.py": text}, *words)
    lines = HEAD.count("\n")
    return [
        (problem.code, problem.span.line - lines, problem.message)
        for problem in problems.errors
        if problem.span is not None
    ]


@pytest.mark.conforms("4.1 1", "4.12 computed", "1.2 Action.execute")
def test_entities_are_visited_in_order_and_what_they_return_right_after_them(tmp_path: Path) -> None:
    text = """
def inner(context):
    return [LogInfo(msg='b'), OpaqueFunction(function=lambda context: [LogInfo(msg='c')]), LogInfo(msg='d')]
def generate_launch_description():
    return LaunchDescription([LogInfo(msg='a'), OpaqueFunction(function=inner), LogInfo(msg='e')])
"""
    assert said(tmp_path, text) == ["a", "b", "c", "d", "e"]


@pytest.mark.conforms(
    "1.2 LaunchContext.launch_configurations", "1.3 OpaqueFunction", "4.2 scoped and forwarding"
)
def test_user_code_reads_and_writes_configurations_of_its_scope(tmp_path: Path) -> None:
    text = """
def raise_it(context, by, *, twice):
    number = int(LaunchConfiguration('n').perform(context))
    context.launch_configurations['n'] = str(number + by * (2 if twice else 1))
def show(context):
    assert 'absent' not in context.launch_configurations
    assert context.launch_configurations.get('absent', 'none') == 'none'
    return [LogInfo(msg=context.launch_configurations['n'])]
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('n', default_value='1'),
        OpaqueFunction(function=raise_it, args=[3], kwargs={'twice': True}),
        OpaqueFunction(function=show),
        GroupAction([OpaqueFunction(function=raise_it, args=[1], kwargs={'twice': False}), OpaqueFunction(function=show)]),
        OpaqueFunction(function=show),
    ])
"""
    assert said(tmp_path, text) == ["7", "8", "7"]
    assert said(tmp_path, text, "n:=10") == ["16", "17", "16"]


@pytest.mark.conforms("1.2 LaunchContext.environment", "D27")
def test_os_environ_is_the_environment_of_the_scope(tmp_path: Path) -> None:
    text = """
os.environ['AT_IMPORT'] = '1'
def look(context):
    os.environ['BY_FUNCTION'] = os.environ['SET'] + os.environ['AT_IMPORT'] + os.environ['GIVEN']
    context.environment['BY_CONTEXT'] = 'x'
    assert os.environ['BY_CONTEXT'] == 'x'
    del os.environ['GONE']
def generate_launch_description():
    return LaunchDescription([
        SetEnvironmentVariable('SET', 's'),
        OpaqueFunction(function=look),
        LogInfo(msg=[EnvironmentVariable('BY_FUNCTION'), EnvironmentVariable('BY_CONTEXT')]),
        LogInfo(msg=EnvironmentVariable('GONE', default_value='gone')),
        ExecuteProcess(cmd=['true']),
    ])
"""
    before = dict(os.environ)
    plan, problems = planned(tmp_path, {"main.launch.py": text}, GIVEN="g", GONE="there")
    assert not problems.errors
    assert plan is not None
    assert messages(plan) == ["s1gx", "gone"]
    assert plan.processes[0].environment == {
        "AT_IMPORT": "1",
        "SET": "s",
        "BY_FUNCTION": "s1g",
        "BY_CONTEXT": "x",
        "GONE": None,
    }
    assert dict(os.environ) == before


@pytest.mark.conforms("D27")
def test_a_resolution_leaves_nothing_of_itself_in_the_process(tmp_path: Path) -> None:
    (tmp_path / "beside.py").write_text("import launch\nCOUNT = []\n")
    text = """
sys.path.append(os.path.dirname(__file__))
import beside
beside.COUNT.append(1)
os.chdir('/')
print('on standard output')
def generate_launch_description():
    return LaunchDescription([LogInfo(msg=str(len(beside.COUNT)) + ' ' + ' '.join(sys.argv[3:]))])
"""
    before = (list(sys.path), list(sys.argv), Path.cwd(), {*sys.modules} & {"launch", "beside"})
    for _ in range(2):
        assert said(tmp_path, text) == ["1 "]
    assert (list(sys.path), list(sys.argv), Path.cwd(), {*sys.modules} & {"launch", "beside"}) == before
    assert not list(tmp_path.rglob("__pycache__"))


@pytest.mark.conforms("D76")
def test_what_launch_files_print_is_not_the_product(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said(tmp_path, "def generate_launch_description():\n    print('hello')\n    return LaunchDescription()\n")
    shown = capsys.readouterr()
    assert (shown.out, shown.err) == ("", "hello\n")


@pytest.mark.conforms("1.2 Substitution", "1.2 Condition", "1.2 Action.execute")
def test_users_own_actions_substitutions_and_conditions(tmp_path: Path) -> None:
    text = """
class Twice(Substitution):
    def __init__(self, inner):
        super().__init__()
        self.inner = inner
    def perform(self, context):
        return 2 * self.inner.perform(context)
class Loud(LogInfo):
    def __init__(self, text, **kwargs):
        super().__init__(msg=[text, '!'], **kwargs)
    def execute(self, context):
        context.launch_configurations['loud'] = 'yes'
        return super().execute(context)
class Several(Action):
    def __init__(self, *actions, **kwargs):
        super().__init__(**kwargs)
        self.actions = actions
    def execute(self, context):
        return list(self.actions)
class Odd(Condition):
    def evaluate(self, context):
        return int(context.launch_configurations['n']) % 2 == 1
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('n', default_value='3'),
        LogInfo(msg=['n', Twice(LaunchConfiguration('n'))]),
        Loud('hey'),
        Several(LogInfo(msg='odd', condition=Odd()), LogInfo(msg=LaunchConfiguration('loud'))),
        Several(LogInfo(msg='never'), condition=Condition(predicate=lambda context: False)),
    ])
"""
    assert said(tmp_path, text) == ["n33", "hey!", "odd", "yes"]
    assert said(tmp_path, text, "n:=4") == ["n44", "hey!", "yes"]


@pytest.mark.conforms("1.2 LaunchDescription.entities")
def test_a_list_of_entities_that_grows_is_visited_to_its_end(tmp_path: Path) -> None:
    text = """
def generate_launch_description():
    ld = LaunchDescription()
    ld.add_action(OpaqueFunction(function=lambda context: ld.add_action(LogInfo(msg='late'))))
    return ld
"""
    assert said(tmp_path, text) == ["late"]


@pytest.mark.conforms("4.3 current file", "D2", "1.4 ThisLaunchFile", "1.4 ThisLaunchFileDir")
def test_an_include_runs_the_file_in_the_environment_of_its_place(tmp_path: Path) -> None:
    main = """
def generate_launch_description():
    def include(n):
        return IncludeLaunchDescription(PythonLaunchDescriptionSource([ThisLaunchFileDir(), '/inner.launch.py']),
                                        launch_arguments={'n': n}.items())
    return LaunchDescription([SetEnvironmentVariable('E', '1'), include('1'), SetEnvironmentVariable('E', '2'), include('2'),
                              LogInfo(msg=ThisLaunchFile())])
"""
    inner = """
E = os.environ['E']
def generate_launch_description():
    return LaunchDescription([DeclareLaunchArgument('n'), LogInfo(msg=[E, ' ', LaunchConfiguration('n'), ' ', ThisLaunchFile()])])
"""
    plan, problems = planned(tmp_path, {"main.launch.py": main, "inner.launch.py": inner})
    assert not problems.errors
    assert plan is not None
    inner_path, main_path = tmp_path / "inner.launch.py", tmp_path / "main.launch.py"
    assert messages(plan) == [f"1 1 {inner_path}", f"2 2 {inner_path}", str(main_path)]


def test_one_description_in_three_languages_gives_one_plan(tmp_path: Path) -> None:
    python = """
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument('a', default_value='1', description='first'),
        SetEnvironmentVariable('E', ['x', LaunchConfiguration('a')]),
        GroupAction([SetLaunchConfiguration('b', '2'), LogInfo(msg=LaunchConfiguration('b'))], condition=IfCondition('true')),
        ExecuteProcess(cmd=['sleep', LaunchConfiguration('a')], name='nap', output='screen', respawn=True, respawn_delay=2.0),
        TimerAction(period=1.5, actions=[Shutdown(reason='enough')]),
    ])
"""
    yaml = """
launch:
- arg: {name: a, default: "1", description: first}
- set_env: {name: E, value: x$(var a)}
- group:
    if: "true"
    children:
    - let: {name: b, value: "2"}
    - log: {message: $(var b)}
- executable: {cmd: sleep $(var a), name: nap, output: screen, respawn: true, respawn_delay: 2.0}
- timer: {period: 1.5, children: [{shutdown: {reason: enough}}]}
"""
    xml = """
<launch>
  <arg name="a" default="1" description="first"/>
  <set_env name="E" value="x$(var a)"/>
  <group if="true"><let name="b" value="2"/><log message="$(var b)"/></group>
  <executable cmd="sleep $(var a)" name="nap" output="screen" respawn="true" respawn_delay="2.0"/>
  <timer period="1.5"><shutdown reason="enough"/></timer>
</launch>
"""
    texts = {"main.launch.py": python, "main.launch.yaml": yaml, "main.launch.xml": xml}
    plans = [_placeless(planned(tmp_path, {name: text})[0]) for name, text in texts.items()]
    assert plans[0] == plans[1] == plans[2]


def _placeless(plan: Plan | None) -> object:
    """Return a plan as data without places."""

    def strip(value: object) -> object:
        if isinstance(value, dict):
            hidden = {"location", "file", "provenance", "line", "column"}
            return {key: strip(item) for key, item in value.items() if key not in hidden}
        return [strip(item) for item in value] if isinstance(value, list) else value

    return strip(encode(plan))


_FAULTS = {
    "no function": (
        "def generate():\n    pass\n",
        Code.NO_DESCRIPTION,
        None,
        "has no function generate_launch_description",
    ),
    "returns nothing": (
        "def generate_launch_description():\n    LaunchDescription()\n",
        Code.NO_DESCRIPTION,
        None,
        "returns nothing",
    ),
    "no Python": ("def generate_launch_description(:\n    pass\n", Code.SYNTAX, 1, "this is not Python"),
    "an import that fails": ("import no_such_module_at_all\n", Code.USER_CODE, 1, "no Python module"),
    "a wrong type": (
        "def generate_launch_description():\n    return LaunchDescription([\n        LogInfo(msg=5)])\n",
        Code.WRONG_TYPE,
        3,
        "expected a text",
    ),
    "a function that raises": (
        "def f(context):\n    x = 1\n    raise KeyError('k')\ndef generate_launch_description():\n    return LaunchDescription([OpaqueFunction(function=f)])\n",
        Code.USER_CODE,
        3,
        "KeyError: 'k'",
    ),
    "a substitution that cannot be performed": (
        "def f(context):\n    return [LogInfo(msg=LaunchConfiguration('no').perform(context))]\ndef generate_launch_description():\n    return LaunchDescription([OpaqueFunction(function=f)])\n",
        Code.UNDEFINED_VARIABLE,
        2,
        "'no'",
    ),
    "no entity": (
        "def generate_launch_description():\n    return LaunchDescription([LogInfo(msg='a'), 'b'])\n",
        Code.WRONG_TYPE,
        None,
        "'b'",
    ),
    "an end of the program": ("sys.exit(3)\n", Code.USER_CODE, 1, "SystemExit(3)"),
    "a condition that is none": (
        "def generate_launch_description():\n    return LaunchDescription([\n        LogInfo(msg='a', condition=IfCondition('maybe'))])\n",
        Code.WRONG_TYPE,
        3,
        "true or false",
    ),
}


@pytest.mark.parametrize("name", _FAULTS)
def test_what_is_wrong_is_told_once_at_the_users_line(tmp_path: Path, name: str) -> None:
    text, code, line, message = _FAULTS[name]
    found = faults(tmp_path, text)
    assert len(found) == 1, found
    assert found[0][0] == code
    assert line is None or found[0][1] == line, found
    assert message in found[0][2]


def test_user_code_may_catch_what_a_substitution_raises(tmp_path: Path) -> None:
    text = """
def f(context):
    try:
        LaunchConfiguration('no').perform(context)
    except SubstitutionFailure:
        return [LogInfo(msg='caught')]
def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=f)])
"""
    assert said(tmp_path, text) == ["caught"]


def test_an_argument_that_only_a_function_reads_is_known(tmp_path: Path) -> None:
    text = """
def f(context):
    return [LogInfo(msg=context.launch_configurations['hidden'])]
def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=f)])
"""
    assert said(tmp_path, text, "hidden:=1") == ["1"]
    found = faults(tmp_path, text, "hidden:=1", "hiden:=2")
    assert [code for code, _, _ in found] == [Code.UNKNOWN_ARGUMENT]


def test_each_process_has_the_environment_of_its_place(tmp_path: Path) -> None:
    """Also where many have the same, and code changes what it is given of one."""
    text = """
first, again, other, outer = (ExecuteProcess(cmd=['true', name]) for name in ('first', 'again', 'other', 'outer'))

def look(context):
    first.env['A'] = 'changed'
    found = [process.env.get('A', '-') for process in (again, other, outer)]
    return [LogInfo(msg=' '.join(found))]

def generate_launch_description():
    inside = GroupAction([SetEnvironmentVariable('A', '2'), other])
    before = SetEnvironmentVariable('A', '1')
    return LaunchDescription([before, first, again, inside, outer, OpaqueFunction(function=look)])
"""
    plan, problems = planned(tmp_path, {"a.launch.py": text})
    assert plan is not None, list(problems)
    assert [action["message"] for trigger in encode(plan)["triggers"] for action in trigger["do"]] == [
        "1 2 1"
    ]


def test_what_a_generator_stops_at_is_told(tmp_path: Path) -> None:
    """Its code runs when what it yields is visited, with the environment of that moment."""
    text = """\
def setup(context):
    yield SetEnvironmentVariable('PLACE', 'here')
    yield LogInfo(msg=os.environ['PLACE'])
    yield LogInfo(msg=LaunchConfiguration('mode').case)

def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=setup)])
"""
    _, problems = planned(tmp_path, {"main.launch.py": text})
    (error,) = problems.errors
    assert error.code is Code.USER_CODE
    assert error.span is not None
    assert error.span.line == len(HEAD.splitlines()) + 4

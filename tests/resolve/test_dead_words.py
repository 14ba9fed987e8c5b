"""What a description says and what never counts: defaults, values, conditions, keys, remaps."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from orchestra.resolve.impossible import comparisons
from tests.plan.checks.told import Told, node, told
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

_WORLD = "- arg: {name: world, default: arena, choices: [arena, maze]}\n"
_GUI = "- arg: {name: gui, default: 'true'}\n- arg: {name: map, default: a}\n"
_NEVER = Code.IMPOSSIBLE_CONDITION


def _say(condition: str) -> str:
    return f"- log: {{message: hi, {condition}}}\n"


def _inside(outer: str, inner: str) -> str:
    return _GUI + f"- group:\n    {outer}\n    children:\n    " + _say(inner)


DEAD: dict[str, tuple[str, list[Told]]] = {
    # Arguments.
    "an argument declared twice": (
        "- arg: {name: x, default: 1}\n- arg: {name: x, default: 2}\n",
        [(Code.SHADOWED_ARGUMENT, "x", None)],
    ),
    "an argument that is set before": (
        "- let: {name: x, value: 1}\n- arg: {name: x, default: 2}\n",
        [(Code.SHADOWED_ARGUMENT, "x", None)],
    ),
    "nothing but settings": (
        "- group:\n    children:\n    - set_env: {name: A, value: b}\n",
        [(Code.IDLE_KEY, "set_env", None)],
    ),
    # Comparisons.
    "a value that is no choice": (
        _WORLD + _say("if: $(equals $(var world) mazee)"),
        [(_NEVER, "mazee", "maze")],
    ),
    "the other way round, and negated": (
        _WORLD + _say("unless: $(not-equals mazee $(var world))"),
        [(_NEVER, "mazee", "maze")],
    ),
    "inside of other logic": (
        _WORLD + _say("if: $(and true $(equals $(var world) mazee))"),
        [(_NEVER, "mazee", "maze")],
    ),
    "in an expression": (
        _WORLD + _say("""if: "$(eval \\"'$(var world)' == 'mazee'\\")" """),
        [(_NEVER, "mazee", "maze")],
    ),
    "in a part of an expression": (
        _WORLD + _say("""if: "$(eval \\"1 == 1 and '$(var world)' != 'mazee'\\")" """),
        [(_NEVER, "mazee", "maze")],
    ),
    "among several in an expression": (
        _WORLD + _say("""if: "$(eval \\"'$(var world)' in ['mazee', 'aren']\\")" """),
        [(_NEVER, "mazee", "maze")],
    ),
    "with text around it": (
        _WORLD + _say("if: $(equals $(var world).yaml maze.yml)"),
        [(_NEVER, "maze.yml", "maze")],
    ),
    "a text against a boolean": (
        _GUI + _say("""if: "$(eval \\"'$(var gui)' == True\\")" """),
        [(_NEVER, "True", None)],
    ),
    # Contradictions.
    "the contrary of what is around": (
        _inside("if: $(var gui)", "unless: $(var gui)"),
        [(_NEVER, "$(var gui)", None)],
    ),
    "its negation": (
        _inside("if: $(var gui)", "if: $(not $(var gui))"),
        [(_NEVER, "$(not $(var gui))", None)],
    ),
    "another value of the same variable": (
        _inside("if: $(equals $(var map) a)", "if: $(equals $(var map) b)"),
        [(_NEVER, "$(equals $(var map) b)", None)],
    ),
    "the same value, denied": (
        _inside("if: $(equals $(var map) a)", "if: $(not-equals a $(var map))"),
        [(_NEVER, "$(not-equals a $(var map))", None)],
    ),
    # Keys.
    "a delay without respawn": (node("a", respawn_delay="2.0"), [(Code.IDLE_KEY, "2.0", None)]),
    "output that nobody sees beside stdin": (
        node("a", stdin="true", output="log"),
        [(Code.IDLE_KEY, "log", None)],
    ),
    "retries without respawn": (node("a", respawn_max_retries="2"), [(Code.IDLE_KEY, "2", None)]),
    "a respawn of what ends the run": (
        node("a", respawn="true", on_exit="shutdown"),
        [(Code.IDLE_KEY, "shutdown", None)],
    ),
    "what is required and never ends": (
        node("a", restart="always", required="true"),
        [(Code.IDLE_KEY, "true", None)],
    ),
    "a time that is said twice": (
        node("a", sigterm_timeout="2.0", stop="{timeout: 3}"),
        [(Code.IDLE_KEY, "2.0", None)],
    ),
    "a delay of what never restarts": (
        node("a", restart="{policy: 'no', delay: 5}"),
        [(Code.IDLE_KEY, "5", None)],
    ),
    "a status that no process has": (
        node("a", success_exit_codes="[0, 300]"),
        [(Code.BAD_VALUE, "300", None)],
    ),
    # Names.
    "a remap to itself": (node("a", remap="[{from: scan, to: scan}]"), [(Code.IDLE_REMAP, "scan", None)]),
    "a parameter without a name": (
        node("a", param="[{name: '', value: 1}]"),
        [(Code.BAD_NAME, "''", None)],
    ),
}


@pytest.mark.parametrize("case", DEAD)
def test_what_never_counts_is_told_once(case: str, tmp_path: Path) -> None:
    actions, faults = DEAD[case]
    found = told(tmp_path, actions)
    assert [(code, text.strip("'"), instead) for code, text, instead in found] == [
        (code, text.strip("'"), instead) for code, text, instead in faults
    ]


ALIVE: dict[str, str] = {
    "the first of two defaults may be left out": "- arg: {name: x, default: 1, if: 'false'}\n- arg: {name: x, default: 2}\n",
    "a default again": "- arg: {name: x, default: true}\n- arg: {name: x, default: 'True'}\n",
    "a value that a scope has taken with it": "- group:\n    children:\n    - let: {name: x, value: 1}\n"
    "- arg: {name: x, default: 2}\n",
    "a choice": _WORLD + _say("if: $(equals $(var world) maze)"),
    "one of several": _WORLD + _say("""if: "$(eval \\"'$(var world)' in ['maze', 'house']\\")" """),
    "no choices": _GUI + _say("if: $(equals $(var map) b)"),
    "a constant": _say("if: false") + _say("if: $(equals a b)"),
    "a text in quotes against a text": _GUI + _say("""if: "$(eval \\"'$(var gui)' == 'true'\\")" """),
    "the same as around": _inside("if: $(var gui)", "if: $(var gui)"),
    "something else than around": _inside("if: $(var gui)", "if: $(equals $(var map) b)"),
    "set anew in between": _GUI + "- group:\n    if: $(var gui)\n    children:\n"
    "    - let: {name: gui, value: 'false'}\n    " + _say("if: $(var gui)"),
    "another value of what is set anew in between": _GUI
    + "- group:\n    if: $(equals $(var map) a)\n    children:\n"
    "    - let: {name: map, value: b}\n    " + _say("if: $(equals $(var map) c)"),
    "a delay with respawn switched off": node("a", respawn="false", respawn_delay="2.0"),
    "what is required and may end": node("a", restart="on-failure", required="true"),
    "a remap by an argument": "- arg: {name: t, default: scan}\n"
    + node("a", remap="[{from: scan, to: $(var t)}]"),
    "settings behind what no setting counts for": "- group:\n    children:\n    - executable: {cmd: sleep}\n"
    "    - push_ros_namespace: {namespace: a}\n    - set_parameter: {name: a, value: b}\n",
    "settings that end with no group": "- group:\n    scoped: false\n    children:\n    "
    + node("a")
    + "    - push_ros_namespace: {namespace: a}\n"
    + node("b"),
    "settings for what comes later": "- timer:\n    period: 1.0\n    children:\n    "
    + node("a")
    + "- set_parameter: {name: use_sim_time, value: true}\n",
    "an environment at the end of a file": node("a") + "- set_env: {name: A, value: b}\n",
    "settings for a node that a group has of its own": "- group:\n    children:\n    - set_env: {name: A, value: b}\n"
    "    - group:\n        - executable: {cmd: 'true'}\n",
    "the ends of signals": node("a", success_exit_codes="[0, 130, -15]"),
}


@pytest.mark.parametrize("case", ALIVE)
def test_what_may_count_is_left_alone(case: str, tmp_path: Path) -> None:
    assert told(tmp_path, ALIVE[case]) == []


@pytest.mark.parametrize(
    "case", [name for name, written in {**DEAD, **ALIVE}.items() if "eval" in str(written)]
)
def test_a_closer_look_at_every_comparison_finds_the_same(
    case: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    actions = ALIVE[case] if case in ALIVE else DEAD[case][0]
    found = told(tmp_path, actions)
    monkeypatch.setattr(comparisons, "_numbers", lambda _: None)
    comparisons._compared.cache_clear()
    assert told(tmp_path, actions) == found
    comparisons._compared.cache_clear()


INNER = "launch:\n- arg: {name: x, default: 1}\n- log: {message: $(var x)}\n"


def test_what_the_caller_gives_is_no_mistake_of_the_file(tmp_path: Path) -> None:
    twice = 2 * "- arg: {name: x, default: 'true'}\n"
    file = f"launch:\n{twice}{_say('if: $(var x)')}{_say('if: $(env QQ_Y)')}"
    assert outcome(tmp_path, file, "x:=yes", environment={"QQ_Y": "on"}).messages == ["hi", "hi"]
    assert outcome(tmp_path, file, "x:=yes", environment={"QQ_Y": "on"}).faults == []


def test_an_argument_that_an_include_gives_twice(tmp_path: Path) -> None:
    main = "launch:\n- include: {file: i.yaml, arg: [{name: x, value: 2}], let: [{name: x, value: 3}]}\n"
    assert told(tmp_path, {"main.launch.yaml": main, "i.yaml": INNER}) == [
        (Code.SHADOWED_ARGUMENT, "x", None)
    ]
    built = main.replace("value: 3", "value: $(var x)0")
    assert told(tmp_path, {"main.launch.yaml": built, "i.yaml": INNER}) == []


def test_a_condition_of_another_file_contradicts_nothing(tmp_path: Path) -> None:
    files = {
        "main.launch.yaml": "launch:\n" + _GUI + "- include: {file: i.yaml, if: $(var gui)}\n",
        "i.yaml": "launch:\n" + _say("unless: $(var gui)"),
    }
    assert told(tmp_path, files) == []


def test_conditions_of_python_files_are_compared_too(tmp_path: Path) -> None:
    text = """from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.conditions import IfCondition, LaunchConfigurationEquals
from launch.substitutions import EqualsSubstitution, LaunchConfiguration, PythonExpression
def generate_launch_description():
    world = LaunchConfiguration('world')
    return LaunchDescription([
        DeclareLaunchArgument('world', default_value='arena', choices=['arena', 'maze']),
        LogInfo(msg='a', condition=IfCondition(PythonExpression(["'", world, "' == 'mazee'"]))),
        LogInfo(msg='b', condition=IfCondition(EqualsSubstitution(world, 'mazee'))),
        LogInfo(msg='c', condition=LaunchConfigurationEquals('world', 'mazee')),
        LogInfo(msg='d', condition=LaunchConfigurationEquals('world', 'maze')),
    ])
"""
    from orchestra.pipeline import check, inputs_from  # noqa: PLC0415 - the only test here that runs Python

    path = tmp_path / "main.launch.py"
    path.write_text(text, "utf-8")
    found = check(str(path), inputs_from([], environment={}))
    assert [(problem.code, problem.span.line, problem.span.column) for problem in found if problem.span] == [
        (_NEVER, 9, 65),
        (_NEVER, 10, 75),
        (_NEVER, 11, 72),
    ]

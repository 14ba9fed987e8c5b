"""Every row of the tables of the launch language does what it says, written in YAML and in XML.

The rows are those of the reference's chapters on the front ends (2.2 to 2.8); `test_grammar_tables` has chapter 3.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from orchestra.description.actions import ACTIONS, model_of
from tests.conformance.marks import conforming
from tests.load.planning import Planned, installed, planned
from tests.load.written import WRITERS, Actions

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

both = pytest.mark.parametrize("language", sorted(WRITERS))
_ENVIRONMENT = {"OUTSIDE": "outer", "PATHS": "/a"}
_INNER: Actions = [
    {"arg": {"name": "a", "default": "default"}},
    {"arg": {"name": "b", "default": "default"}},
    {"log": {"message": "$(var a) $(var b)"}},
]

Row = tuple[Actions, "Callable[[Planned], Any]", Any]


def _says(*names: str) -> dict[str, Any]:
    return {"log": {"message": " ".join(f"$(var {name} none)" for name in names)}}


def _node(**keys: Any) -> Actions:
    return [{"node": {"exec": "exe", **keys}}]


def _program(**keys: Any) -> Actions:
    return [{"executable": {"cmd": "prog", **keys}}]


def _container(**keys: Any) -> Actions:
    component = {"pkg": "p", "plugin": "P", "name": "n", **keys}
    return [{"node_container": {"exec": "exe", "name": "c", "namespace": "", "composable_node": [component]}}]


def _component(*keys: str) -> Callable[[Planned], Any]:
    def values(plan: Planned) -> Any:
        (component,) = plan.content["components"]
        return [component[key] for key in keys]

    return values


def _messages(plan: Planned) -> list[str]:
    return plan.messages


def _problems(plan: Planned) -> list[str]:
    return [severity for _, severity in plan.problems]


def _one(key: str) -> Callable[[Planned], Any]:
    def value(plan: Planned) -> Any:
        (process,) = plan.processes
        return process[key]

    return value


def _of_one(*keys: str) -> Callable[[Planned], Any]:
    return lambda plan: [plan.processes[0][key] for key in keys]


def _of(key: str, *names: str) -> Callable[[Planned], Any]:
    return lambda plan: [plan.processes[0][key][name] for name in names]


def _arguments(*keys: str) -> Callable[[Planned], Any]:
    return lambda plan: [tuple(argument[key] for key in keys) for argument in plan.content["arguments"]]


def _delays(plan: Planned) -> list[tuple[Any, Any]]:
    return [
        (trigger["delay"], [step["message"] for step in trigger["do"]])
        for trigger in plan.content["triggers"]
    ]


ROWS: dict[str, Row] = {
    # 2.2 How nested things are written
    "2.2 attribute": ([{"let": {"name": "a", "value": "b"}}, _says("a")], _messages, ["b"]),
    "2.2 list of sub-entities": (
        _program(env=[{"name": "A", "value": "b"}, {"name": "C", "value": "d"}]), _one("environment"), {"A": "b", "C": "d"},
    ),
    "2.2 list of sub-entities, empty": (_program(env=[]), _one("environment"), {}),
    "2.2 actions inside a group": (
        [{"group": {"children": [{"log": {"message": "a"}}, {"log": {"message": "b"}}]}}], _messages, ["a", "b"],
    ),
    "2.2 actions inside a timer": (
        [{"timer": {"period": 1.5, "children": [{"log": {"message": "a"}}]}}], _delays, [(1.5, ["a"])],
    ),
    "2.2 attribute-less action": ([{"reset_env": {}}], _problems, []),
    "2.2 attribute-less action, null": ([{"shutdown": None}], _problems, []),
    "2.2 list-valued attribute": (
        _node(name="n", param=[{"name": "p", "value": ["a", "b"]}]), _one("parameters"), {"p": ["a", "b"]},
    ),
    # 2.4 Tags
    "2.4 arg name": ([{"arg": {"name": r"a\b", "default": "c"}}], _arguments("name"), [("ab",)]),
    "2.4 arg default": ([{"arg": {"name": "a", "default": "x$(not false)"}}, _says("a")], _messages, ["xtrue"]),
    "2.4 arg default, native": ([{"arg": {"name": "a", "default": 5}}, _says("a")], _messages, ["5"]),
    "2.4 arg description": (
        [{"arg": {"name": "a", "default": "b", "description": r"\$(c)"}}], _arguments("description"), [("$(c)",)],
    ),
    "2.4 arg choice": (
        [{"arg": {"name": "a", "default": "b", "choice": [{"value": "b"}, {"value": "c"}]}}],
        _arguments("choices"), [(["b", "c"],)],
    ),
    "2.4 arg choice, none of them": (
        [{"arg": {"name": "a", "default": "d", "choice": [{"value": "b"}, {"value": "c"}]}}], _problems, ["error"],
    ),
    "2.4 arg choice, empty": ([{"arg": {"name": "a", "choices": []}}], lambda plan: plan.failed, True),
    "2.4 let name": ([{"let": {"name": "$(not true)", "value": "a"}}, _says("false")], _messages, ["a"]),
    "2.4 let value": ([{"let": {"name": "a", "value": "$(not true)"}}, _says("a")], _messages, ["false"]),
    "2.4 log message": ([{"log": {"message": "a $(not true)"}}], _messages, ["a false"]),
    "2.4 group scoped": (
        [{"group": {"children": [{"let": {"name": "a", "value": "b"}}]}}, _says("a")], _messages, ["none"],
    ),
    "2.4 group scoped, false": (
        [{"group": {"scoped": False, "children": [{"let": {"name": "a", "value": "b"}}]}}, _says("a")], _messages, ["b"],
    ),
    "2.4 group forwarding, false": (
        [{"let": {"name": "a", "value": "b"}}, {"group": {"forwarding": False, "children": [_says("a")]}}],
        _messages, ["none"],
    ),
    "2.4 group keep": (
        [
            {"let": {"name": "a", "value": "b"}},
            {"group": {
                "forwarding": "false",
                "keep": [{"name": "$(var a)", "value": "kept $(var a)"}],
                "children": [_says("a", "b")],
            }},
        ],
        _messages, ["none kept b"],
    ),
    "2.4 group children": ([{"group": {"children": []}}], _problems, []),
    "2.4 include file": ([{"include": {"file": "inner.launch.yaml"}}], _messages, ["default default"]),
    "2.4 include arg": (
        [{"include": {"file": "inner.launch.yaml", "arg": [{"name": "a", "value": "$(not true)"}, {"name": "b", "value": 1}]}}],
        _messages, ["false 1"],
    ),
    "2.4 include let": (
        [{"include": {"file": "inner.launch.yaml", "let": [{"name": "a", "value": "c"}]}}], _messages, ["c default"],
    ),
    "2.4 executable cmd": ([{"executable": {"cmd": "a 'b c' $(not true)"}}], _one("command"), ["a", "b c", "false"]),
    "2.4 executable cwd": (_program(cwd="/$(not true)"), _one("cwd"), "/false"),
    "2.4 executable name": (_program(name="label"), _one("id"), "label"),
    "2.4 executable on_exit": (_program(on_exit="shutdown"), _one("required"), True),
    "2.4 executable on_exit, another word": (_program(on_exit="stop"), _problems, ["error"]),
    "2.4 executable launch-prefix": (
        [{"executable": {"cmd": "prog", "launch-prefix": "nice -n $(eval 2+3)"}}], _one("prefix"), ["nice", "-n", "5"],
    ),
    "2.4 executable launch-prefix, underscore": (_program(launch_prefix="nice"), _one("prefix"), ["nice"]),
    "2.4 executable output": (_program(output="$(if true log screen)"), _one("output"), "log"),
    "2.4 executable respawn": (
        _program(respawn=True, respawn_delay=2, respawn_max_retries=3),
        lambda plan: [plan.processes[0]["restart"][key] for key in ("policy", "delay", "budget")], ["always", 2.0, 3],
    ),
    "2.4 executable respawn, as text": (
        _program(respawn="$(not false)", respawn_delay="2.0", respawn_max_retries="-1"),
        lambda plan: [plan.processes[0]["restart"][key] for key in ("policy", "delay", "budget")], ["always", 2.0, None],
    ),
    "2.4 executable respawn_delay, negative": (_program(respawn=True, respawn_delay=-1), _problems, ["error"]),
    "2.4 executable respawn_max_retries": (
        _program(respawn=True, respawn_max_retries="2"), lambda plan: plan.processes[0]["restart"]["budget"], 2,
    ),
    "2.4 executable respawn_max_retries, a text": (_program(respawn_max_retries="two"), _problems, ["error"]),
    "2.4 executable sigterm_timeout, sigkill_timeout": (
        _program(sigterm_timeout=1, sigkill_timeout="0.5"), _of("stop", "timeout", "kill_timeout"), [1.0, 0.5],
    ),
    "2.4 executable shell": ([{"executable": {"cmd": "prog", "shell": True}}], _one("shell"), True),
    "2.4 executable emulate_tty": (_program(emulate_tty="false"), _one("emulate_tty"), False),
    "2.4 executable env": (
        _program(env=[{"name": "A_$(not true)", "value": "$(env OUTSIDE)"}, {"name": "B", "value": 1}]),
        _one("environment"), {"A_false": "outer", "B": "1"},
    ),
    "2.4 node pkg": (
        [{"node": {"pkg": "$(if true demo x)", "exec": "tool"}}],
        lambda plan: [plan.processes[0][key] for key in ("package", "executable")], ["demo", "tool"],
    ),
    "2.4 node exec": ([{"node": {"exec": "$(if true exe x)"}}], _one("executable"), "exe"),
    "2.4 node exec, missing": ([{"node": {"pkg": "a"}}], _problems, ["error"]),
    "2.4 node name": (_node(name="n$(eval 1+1)"), _one("name"), "n2"),
    "2.4 node namespace": (_node(name="n", namespace="a/$(not true)"), _one("id"), "/a/false/n"),
    "2.4 node exec_name": (_node(exec_name="label"), _one("executable"), "exe"),
    "2.4 node args": (
        _node(args="--a 'b c' $(not true)"), lambda plan: plan.processes[0]["command"][1:4], ["--a", "b c", "false"],
    ),
    "2.4 node ros_args": (
        _node(ros_args="--log-level $(if true debug x)"),
        lambda plan: plan.processes[0]["command"][1:], ["--ros-args", "--log-level", "debug", "--ros-args"],
    ),
    "2.4 node node-name": ([{"node": {"exec": "exe", "node-name": "n"}}], _problems, ["error"]),
    "2.4 node keys of executable": (
        _node(**{
            "cwd": "/", "on_exit": "shutdown", "launch-prefix": "nice", "output": "screen", "shell": True,
            "emulate_tty": True, "env": [{"name": "A", "value": "b"}],
        }),
        _of_one("cwd", "required", "prefix", "output", "shell", "emulate_tty", "environment"),
        ["/", True, ["nice"], "screen", True, True, {"A": "b"}],
    ),
    "2.4 node param": (
        _node(name="n", param=[{"name": "a", "value": 1}, {"from": "p.yaml"}, {"name": "a", "value": 2}]),
        _one("parameters"), {"a": 2, "from_file": "$(var a)"},
    ),
    "2.4 node remap": (
        _node(name="n", remap=[{"from": "a", "to": "$(not true)"}, {"from": "~/b", "to": "/c"}]),
        _one("remappings"), [["a", "false"], ["~/b", "/c"]],
    ),
    "2.4 set_env": (
        [{"set_env": {"name": "A", "value": "$(env OUTSIDE)"}}, *_program()], _one("environment"), {"A": "outer"},
    ),
    "2.4 unset_env": ([{"unset_env": {"name": "OUTSIDE"}}, *_program()], _one("environment"), {"OUTSIDE": None}),
    "2.4 append_env": (
        [{"append_env": {"name": "PATHS", "value": "/b"}}, {"append_env": {"name": "NEW", "value": "c"}}, *_program()],
        _one("environment"), {"PATHS": "/a:/b", "NEW": "c"},
    ),
    "2.4 append_env prepend": (
        [{"append_env": {"name": "PATHS", "value": "/b", "prepend": True}}, *_program()],
        _one("environment"), {"PATHS": "/b:/a"},
    ),
    "2.4 append_env prepend, as text": (
        [{"append_env": {"name": "PATHS", "value": "/b", "prepend": "$(not false)"}}, *_program()],
        _one("environment"), {"PATHS": "/b:/a"},
    ),
    "2.4 append_env separator": (
        [{"append_env": {"name": "PATHS", "value": "b", "separator": ", "}}, *_program()],
        _one("environment"), {"PATHS": "/a, b"},
    ),
    "2.4 reset_env": (
        [{"set_env": {"name": "A", "value": "b"}}, {"reset_env": {}}, *_program()], _one("environment"), {},
    ),
    "2.4 reset": ([{"let": {"name": "a", "value": "b"}}, {"reset": {}}, _says("a")], _messages, ["none"]),
    "2.4 reset keep": (
        [
            {"let": {"name": "a", "value": "b"}},
            {"reset": {"keep": [{"name": "c", "value": "was $(var a)"}]}},
            _says("a", "c"),
        ],
        _messages, ["none was b"],
    ),
    "2.4 timer period": (
        [{"timer": {"period": "$(eval 1+1)", "children": [{"log": {"message": "a"}}]}}], _delays, [(2.0, ["a"])],
    ),
    "2.4 timer cancel_on_shutdown": (
        [{"timer": {"period": 1, "cancel_on_shutdown": "$(not true)", "children": []}}], _problems, [],
    ),
    "2.4 timer children": (
        [{"timer": {"period": 1.0, "children": [{"log": {"message": "a"}}, {"log": {"message": "b"}}]}}],
        _delays, [(1.0, ["a", "b"])],
    ),
    "2.4 timer period, missing": ([{"timer": {"children": []}}], _problems, ["error"]),
    "2.4 shutdown reason": (
        [{"shutdown": {"reason": "$(not true)"}}],
        lambda plan: [step["reason"] for step in plan.content["triggers"][0]["do"]], ["false"],
    ),
    "2.4 push_ros_namespace": (
        [{"push_ros_namespace": {"namespace": "$(not true)"}}, *_node(name="n")], _one("id"), "/false/n",
    ),
    "2.4 push_ros_namespace, hyphens": ([{"push-ros-namespace": {"namespace": "a"}}, *_node(name="n")], _one("id"), "/a/n"),
    "2.4 set_parameter": (
        [{"set_parameter": {"name": "$(not true)", "value": "$(eval 1+1)"}}, *_node(name="n")],
        _one("parameters"), {"false": 2},
    ),
    "2.4 set_parameter, native": (
        [{"set_parameter": {"name": "a", "value": True}}, *_node(name="n")], _one("parameters"), {"a": True},
    ),
    "2.4 set_parameters_from_file": (
        [{"set_parameters_from_file": {"filename": "$(dirname)/p.yaml"}}, *_node(name="n")],
        _one("parameters"), {"from_file": "$(var a)"},
    ),
    "2.4 set_remap": ([{"set_remap": {"from": "a", "to": "$(not true)"}}, *_node(name="n")], _one("remappings"), [["a", "false"]]),
    "2.4 set_ros_log_dir": (
        [{"set_ros_log_dir": {"new_log_dir": "/$(not true)"}}, *_program()], _one("environment"), {"ROS_LOG_DIR": "/false"},
    ),
    "2.4 set_use_sim_time": ([{"set_use_sim_time": {"value": True}}], _problems, []),
    "2.4 ros_timer": (
        [{"ros_timer": {"period": 2, "children": [{"log": {"message": "a"}}]}}], _delays, [(2.0, ["a"])],
    ),
    "2.4 node_container": (
        [{"node_container": {"exec": "exe", "name": "c", "namespace": "ns", "param": [{"name": "a", "value": 1}]}}],
        lambda plan: [plan.processes[0][key] for key in ("kind", "id", "parameters")], ["container", "/ns/c", {"a": 1}],
    ),
    "2.4 node_container, name missing": (
        [{"node_container": {"exec": "exe", "namespace": ""}}], _problems, ["error"],
    ),
    "2.4 node_container, namespace missing": (
        [{"node_container": {"exec": "exe", "name": "c"}}], _problems, ["error"],
    ),
    "2.4 node_container, namespace empty": (
        [{"node_container": {"exec": "exe", "name": "c", "namespace": ""}}], _one("id"), "/c",
    ),
    "2.4 node_container composable_node": (_container(), _component("container", "package", "plugin"), ["/c", "p", "P"]),
    "2.4 load_composable_node target": (
        [{"load_composable_node": {"target": "/$(not true)", "composable_node": [{"pkg": "p", "plugin": "P", "name": "n"}]}}],
        _component("container", "package", "plugin"), ["/false", "p", "P"],
    ),
    "2.4 load_composable_node composable_node, missing": (
        [{"load_composable_node": {"target": "/c"}}], _problems, ["error"],
    ),
    "2.4 composable_node pkg, plugin, name": (
        _container(pkg="$(not true)", plugin="$(not false)", name="n$(eval 2)"),
        _component("package", "plugin", "name"), ["false", "true", "n2"],
    ),
    "2.4 composable_node namespace": (_container(namespace="in"), _component("id"), ["/in/n"]),
    "2.4 composable_node param": (
        _container(param=[{"name": "a", "param": [{"name": "b", "value": 1}]}, {"from": "p.yaml"}]),
        _component("parameters"), [{"a.b": 1, "from_file": "$(var a)"}],
    ),
    "2.4 composable_node param, remap": (
        _container(remap=[{"from": "a", "to": "b"}]), _component("remappings"), [[["a", "b"]]],
    ),
    "2.4 composable_node extra_arg": (
        _container(extra_arg=[{"name": "use_intra_process_comms", "value": "$(not false)"}, {"name": "b", "value": False}]),
        _component("extra_arguments"), [{"use_intra_process_comms": True, "b": False}],
    ),
    "2.4 composable_node if": (_container(**{"if": "$(not true)"}), lambda plan: plan.content["components"], []),
    "2.4 composable_node if, unless": (_container(unless="true"), lambda plan: plan.content["components"], []),
    "2.4 composable_node if, and unless": (_container(unless="true", **{"if": "true"}), lambda plan: plan.failed, True),
    # 2.5 param
    "2.5 value": (
        _node(name="n", param=[{"name": "$(not true)", "value": 1}, {"name": "b", "value": 2.5}]),
        _one("parameters"), {"false": 1, "b": 2.5},
    ),
    "2.5 nested": (
        _node(name="n", param=[{"name": "a", "param": [{"name": "b", "param": [{"name": "c", "value": 1}]}, {"name": "d", "value": 2}]}]),
        _one("parameters"), {"a.b.c": 1, "a.d": 2},
    ),
    "2.5 file": (_node(name="n", param=[{"from": "p.yaml"}]), _one("parameters"), {"from_file": "$(var a)"}),
    "2.5 file, allow_substs": (
        [{"let": {"name": "a", "value": "7"}}, *_node(name="n", param=[{"from": "p.yaml", "allow_substs": True}])],
        _one("parameters"), {"from_file": 7},
    ),
    "2.5 file, allow_substs as text": (
        [{"let": {"name": "a", "value": "7"}}, *_node(name="n", param=[{"from": "p.yaml", "allow_substs": "$(not true)"}])],
        _one("parameters"), {"from_file": "$(var a)"},
    ),
    "2.5 errors, name and from": (_node(param=[{"name": "a", "from": "p.yaml"}]), _problems, ["error"]),
    "2.5 errors, neither": (_node(param=[{"value": 1}]), _problems, ["error"]),
    "2.5 errors, value and nested": (
        _node(param=[{"name": "a", "value": 1, "param": [{"name": "b", "value": 1}]}]), _problems, ["error"],
    ),
    "2.5 errors, type and nested": (
        _node(param=[{"name": "a", "type": "int", "param": [{"name": "b", "value": 1}]}]), _problems, ["error"],
    ),
    "2.5 errors, neither value nor nested": (_node(param=[{"name": "a"}]), _problems, ["error"]),
    "2.5 errors, allow_substs without from": (
        _node(param=[{"name": "a", "value": 1, "allow_substs": True}]), _problems, ["error"],
    ),
    "2.5 errors, another type": (_node(param=[{"name": "a", "value": 1, "type": "integer"}]), _problems, ["error"]),
    # 2.8 Splitting
    "2.8 shell words": ([{"executable": {"cmd": "ls -l \"a b\" 'c d'e"}}], _one("command"), ["ls", "-l", "a b", "c de"]),
    "2.8 quotes around a substitution": (
        [{"let": {"name": "a", "value": "A"}}, {"executable": {"cmd": "x \"a $(var a) b\" --x='$(var a)'"}}],
        _one("command"), ["x", "a A b", "--x=A"],
    ),
    "2.8 substitutions in words, never split": (
        [{"let": {"name": "a", "value": "b c"}}, {"executable": {"cmd": "x $(var a)y"}}], _one("command"), ["x", "b cy"],
    ),
}  # fmt: skip


@pytest.mark.conforms("D11")
@both
@pytest.mark.parametrize("row", conforming(ROWS))
def test_a_row_does_what_it_says(row: str, language: str, tmp_path: Path) -> None:
    (tmp_path / "p.yaml").write_text("/**: {ros__parameters: {from_file: $(var a)}}")
    actions, view, expected = ROWS[row]
    plan = planned(tmp_path, language, actions, {**installed(tmp_path), **_ENVIRONMENT}, inner=_INNER)
    assert view(plan) == expected, plan.problems
    if view is not _problems and expected is not True:
        assert not plan.failed, plan.problems


# 2.3: what an action needs beside its condition.
_NEEDED: dict[str, dict[str, Any]] = {
    "append_env": {"name": "a", "value": "b"},
    "arg": {"name": "a", "default": "b"},
    "executable": {"cmd": "a"},
    "for": {"len": 1, "name": "i", "children": [{"log": {"message": "a"}}]},
    "for_each": {"values": "{a: b}", "children": [{"log": {"message": "a"}}]},
    "group": {"children": [{"log": {"message": "a"}}]},
    "include": {"file": "inner.launch.yaml"},
    "let": {"name": "a", "value": "b"},
    "lifecycle_node": {"exec": "e", "name": "n", "namespace": ""},
    "load_composable_node": {"target": "/c", "composable_node": [{"pkg": "p", "plugin": "P", "name": "n"}]},
    "log": {"message": "a"},
    "node": {"exec": "e"},
    "node_container": {"exec": "e", "name": "n", "namespace": ""},
    "push_ros_namespace": {"namespace": "a"},
    "reset": {},
    "reset_env": {},
    "ros_timer": {"period": 1, "children": [{"log": {"message": "a"}}]},
    "set_env": {"name": "a", "value": "b"},
    "set_parameter": {"name": "a", "value": 1},
    "set_parameters_from_file": {"filename": "nowhere.yaml"},
    "set_remap": {"from": "a", "to": "b"},
    "set_ros_log_dir": {"new_log_dir": "a"},
    "set_use_sim_time": {"value": True},
    "shutdown": {},
    "timer": {"period": 1, "children": [{"log": {"message": "a"}}]},
    "unset_env": {"name": "a"},
}


@pytest.mark.conforms("2.4 names")
def test_no_action_is_forgotten() -> None:
    assert set(_NEEDED) == set(ACTIONS)
    for name, keys in _NEEDED.items():
        model = model_of(name)
        assert model is not None
        assert model.required_keys() <= set(keys)


@pytest.mark.conforms("2.3 every action", "2.4 all actions")
@both
@pytest.mark.parametrize("action", _NEEDED)
@pytest.mark.parametrize("condition", [{"if": "$(not true)"}, {"unless": True}])
def test_every_action_has_a_condition(
    action: str, condition: dict[str, Any], language: str, tmp_path: Path
) -> None:
    plan = planned(
        tmp_path, language, [{action: {**_NEEDED[action], **condition}}], _ENVIRONMENT, inner=_INNER
    )
    assert plan.problems == ()
    assert plan.content["skipped"]
    assert not plan.processes
    assert not plan.content["triggers"]
    assert not plan.content["components"]


@pytest.mark.conforms("2.3 both")
@both
@pytest.mark.parametrize("action", _NEEDED)
def test_no_action_has_two_conditions(action: str, language: str, tmp_path: Path) -> None:
    keys = {**_NEEDED[action], "if": "true", "unless": "false"}
    assert planned(tmp_path, language, [{action: keys}], _ENVIRONMENT, inner=_INNER).failed


@pytest.mark.conforms("2.3 parts of an action")
@both
@pytest.mark.parametrize(
    "actions",
    [
        _program(env=[{"name": "a", "value": "b", "if": "true"}]),
        _node(param=[{"name": "a", "value": 1, "if": "true"}]),
        _node(remap=[{"from": "a", "to": "b", "if": "true"}]),
        [{"include": {"file": "inner.launch.yaml", "arg": [{"name": "a", "value": "b", "if": "true"}]}}],
        [{"group": {"keep": [{"name": "a", "value": "b", "if": "true"}], "children": []}}],
        [{"arg": {"name": "a", "default": "b", "choice": [{"value": "b", "if": "true"}]}}],
    ],
)
def test_no_part_of_an_action_has_a_condition(actions: Actions, language: str, tmp_path: Path) -> None:
    assert _problems(planned(tmp_path, language, actions, _ENVIRONMENT, inner=_INNER)) == ["error"]

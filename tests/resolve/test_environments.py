"""Environments: appended to, reset, saved and restored; what a process gets of them."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path

_OUTSIDE = {"A": "x", "PATH": os.defpath}

ENVIRONMENTS: dict[str, tuple[str, dict[str, str | None]]] = {
    "it is appended with a colon": ("append_env: {name: A, value: y}", {"A": "x:y"}),
    "or put in front": ("append_env: {name: A, value: y, prepend: true}", {"A": "y:x"}),
    "or with another separator": ("append_env: {name: A, value: y, separator: ;}", {"A": "x;y"}),
    "or with none": ("append_env: {name: A, value: y, separator: ''}", {"A": "xy"}),
    "what is unset gets the text alone": ("append_env: {name: NEW, value: y, separator: ;}", {"NEW": "y"}),
    "a reset takes all changes back": ("reset_env: {}", {}),
    "prepend may be a text": ("append_env: {name: A, value: y, prepend: $(env YES true)}", {"A": "y:x"}),
    "the log folder is set": ("set_ros_log_dir: {new_log_dir: /var/log}", {"ROS_LOG_DIR": "/var/log"}),
    "a relative one is below that of the run": (
        "set_ros_log_dir: {new_log_dir: a}",
        {"ROS_LOG_DIR": "${run}/logs/a"},
    ),
}


@pytest.mark.conforms("1.3 SetEnvironmentVariable", "1.3 AppendEnvironmentVariable")
@pytest.mark.parametrize("case", ENVIRONMENTS)
def test_what_a_process_gets(case: str, tmp_path: Path) -> None:
    action, expected = ENVIRONMENTS[case]
    text = f"launch:\n- {action}\n- executable: {{cmd: sleep 1}}"
    found = outcome(tmp_path, text, environment=_OUTSIDE)
    assert list(found.problems) == []
    assert found.plan.processes[0].environment == expected


@pytest.mark.conforms("1.12 SetROSLogDir", "2.4 set_ros_log_dir", "4.10 ROS_LOG_DIR")
@pytest.mark.parametrize(
    ("environment", "folder"),
    [
        ({"ROS_LOG_DIR": "/logs"}, "/logs/a"),
        ({"ROS_HOME": "/ros"}, "/ros/log/a"),
        ({"ROS_LOG_DIR": "/logs", "ROS_HOME": "/ros"}, "/logs/a"),
    ],
)
def test_log_folders_are_below_what_rcl_would_use(
    environment: dict[str, str], folder: str, tmp_path: Path
) -> None:
    text = """launch:
- set_ros_log_dir: {new_log_dir: a}
- set_ros_log_dir: {new_log_dir: b}
- executable: {cmd: sleep 1}"""
    (process,) = outcome(tmp_path, text, environment=environment).plan.processes
    assert process.environment == {"ROS_LOG_DIR": f"{folder}/b"}


@pytest.mark.conforms("1.3 ResetEnvironment")
def test_a_reset_is_undone_where_its_scope_ends(tmp_path: Path) -> None:
    text = """launch:
- set_env: {name: A, value: y}
- let: {name: t, value: out}
- push_ros_namespace: {namespace: ns}
- set_parameter: {name: p, value: 1}
- set_remap: {from: a, to: b}
- group:
  - reset_env
  - reset: {keep: [{name: k, value: $(var t)}]}
  - node: {exec: sleep, name: in, env: [{name: K, value: "$(var k)$(var t -)$(env A)"}]}
- node: {exec: sleep, name: out, env: [{name: K, value: "$(var k -)$(var t)$(env A)"}]}
"""
    text = text.replace("  - reset_env\n", "  - reset_env: {}\n")
    inner, outer = outcome(tmp_path, text, environment=_OUTSIDE).plan.processes
    assert (inner.id, inner.environment, inner.parameters, inner.remappings) == (
        "/in",
        {"K": "out-x"},
        {},
        (),
    )
    assert (outer.id, outer.environment, outer.parameters, outer.remappings) == (
        "/ns/out",
        {"A": "y", "K": "-outy"},
        {"p": 1},
        (("a", "b"),),
    )


@pytest.mark.conforms("4.2 scoped without forwarding")
def test_a_group_without_forwarding_begins_as_the_launch_did(tmp_path: Path) -> None:
    text = """launch:
- set_env: {name: A, value: y}
- push_ros_namespace: {namespace: ns}
- set_parameter: {name: p, value: 1}
- set_remap: {from: a, to: b}
- group:
    forwarding: false
    children:
    - set_parameter: {name: q, value: 2}
    - node: {exec: sleep, name: n, env: [{name: K, value: $(env A)}]}
- node: {exec: sleep, name: n}
"""
    inner, outer = outcome(tmp_path, text, environment=_OUTSIDE).plan.processes
    assert (inner.id, inner.environment, inner.parameters, inner.remappings) == (
        "/n",
        {"K": "x"},
        {"q": 2},
        (),
    )
    assert (outer.id, outer.environment, outer.parameters) == ("/ns/n", {"A": "y"}, {"p": 1})


@pytest.mark.conforms("1.3.2 env")
def test_a_whole_environment_is_all_that_a_process_gets(tmp_path: Path) -> None:
    text = """launch:
- set_env: {name: A, value: y}
- executable:
    cmd: sleep 1
    env_only: [{name: B, value: $(env A)}]
    env: [{name: C, value: c}]
"""
    (process,) = outcome(tmp_path, text).plan.processes
    assert process.environment == {"B": "y", "C": "c"}
    assert not process.inherit_environment


OUTPUTS = {
    "screen": "screen",
    "{both: screen}": "screen",
    "{stdout: screen, stderr: screen}": "screen",
    "{stdout: log, stderr: [log, screen]}": "log",
    "{both: [log, screen]}": "both",
    "{stdout: own_log, stderr: own_log, both: own_log}": "own_log",
    "{stdout: own_log, stderr: own_log, both: [own_log, log, screen]}": "full",
    "{both: own_log}": {"both": ("own_log",)},
    "{stderr: $(env WHERE screen)}": {"stderr": ("screen",)},
}


@pytest.mark.conforms("4.10 by stream")
@pytest.mark.parametrize("written", OUTPUTS)
def test_places_of_output_are_a_word_where_one_says_the_same(written: str, tmp_path: Path) -> None:
    text = f"launch:\n- executable: {{cmd: sleep 1, output: {written}}}"
    (process,) = outcome(tmp_path, text, environment={}).plan.processes
    assert process.output == OUTPUTS[written]


@pytest.mark.conforms("4.10 by stream")
@pytest.mark.parametrize(
    ("written", "code"),
    [
        ("{}", Code.WRONG_TYPE),
        ("{stdin: log}", Code.UNKNOWN_KEY),
        ("{stdout: file}", Code.WRONG_TYPE),
        ("{stdout: [log, file]}", Code.WRONG_TYPE),
        ("[log]", Code.WRONG_TYPE),
    ],
)
def test_other_places_are_refused(written: str, code: Code, tmp_path: Path) -> None:
    found = outcome(tmp_path, f"launch:\n- executable: {{cmd: sleep 1, output: {written}}}")
    assert [problem.code for problem in found.problems] == [code]


@pytest.mark.conforms("4.10 OVERRIDE_LAUNCH_PROCESS_OUTPUT")
def test_the_caller_can_say_where_all_output_goes(tmp_path: Path) -> None:
    text = "launch:\n- executable: {cmd: sleep 1, output: screen}"
    environment = {"OVERRIDE_LAUNCH_PROCESS_OUTPUT": "own_log"}
    assert outcome(tmp_path, text, environment=environment).plan.processes[0].output == "own_log"
    environment = {"OVERRIDE_LAUNCH_PROCESS_OUTPUT": "everywhere"}
    assert outcome(tmp_path, text, environment=environment).faults == [(Code.BAD_VALUE, "main.yaml", 2, 3)]


PREFIXES = {
    "a text is split behind its substitutions": ("$(var tool)", ("gdb", "-ex", "run me", "--args")),
    "a list is not": ("[gdb, '-ex run']", ("gdb", "-ex run")),
    "an empty one keeps that of the launch away": ("''", ()),
}


@pytest.mark.conforms("1.3.2 prefix", "1.3.2 launch-prefix-filter")
@pytest.mark.parametrize("case", PREFIXES)
def test_the_prefix_of_a_process(case: str, tmp_path: Path) -> None:
    written, prefix = PREFIXES[case]
    text = f"""launch:
- let: {{name: launch-prefix, value: nice}}
- let: {{name: tool, value: 'gdb -ex "run me" --args'}}
- node: {{exec: sleep, launch-prefix: {written}}}"""
    (process,) = outcome(tmp_path, text).plan.processes
    assert (process.prefix, process.id) == (prefix, "/sleep")
    assert process.command == (*prefix, "sleep", "--ros-args")


def test_words_may_be_a_list(tmp_path: Path) -> None:
    text = """launch:
- let: {name: v, value: "c d"}
- executable: {cmd: [echo, "a b", $(var v)]}
- node: {exec: sleep, args: [1, "2 3"], ros_args: [--log-level, $(var v)]}"""
    program, node = outcome(tmp_path, text).plan.processes
    assert program.command == ("echo", "a b", "c d")
    assert node.command == ("sleep", "1", "2 3", "--ros-args", "--log-level", "c d", "--ros-args")


@pytest.mark.parametrize(("name", "told"), [("''", "is empty"), ("A=B", "it holds '='")])
@pytest.mark.parametrize(
    "action",
    [
        "set_env: {name: NAME, value: y}",
        "append_env: {name: NAME, value: y}",
        "executable: {cmd: sleep 1, env: [{name: NAME, value: y}]}",
    ],
)
def test_a_name_that_no_variable_can_have_is_told(name: str, told: str, action: str, tmp_path: Path) -> None:
    text = f"launch:\n- {action.replace('NAME', name)}\n- executable: {{cmd: sleep 1}}"
    (problem,) = outcome(tmp_path, text).problems
    assert (problem.code, told in problem.message) == (Code.BAD_NAME, True)

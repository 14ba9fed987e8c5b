"""What a description comes to: ids, command lines, parameters, edges, and what is refused."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code, Severity
from orchestra.plan.codec import dumps, loads
from orchestra.plan.parameter_file import contents
from tests.resolve.launching import outcome

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.conforms(
    "4.5 order", "4.5 arguments and ROS arguments", "1.12.1 arguments", "1.12.1 ros_arguments"
)
def test_the_command_line_of_a_node_is_upstreams_in_its_order(tmp_path: Path) -> None:
    text = """launch:
- arg: {name: launch-prefix, default: nice -n 1}
- push_ros_namespace: {namespace: a}
- set_parameter: {name: p, value: 1}
- set_remap: {from: x, to: y}
- node:
    exec: sleep
    name: n
    namespace: b
    args: one "two three" $(eval '1 + 1')
    ros_args: --log-level debug
    param: [{name: q, value: true}]
    remap: [{from: chatter, to: /talk}]
"""
    process = outcome(tmp_path, text).process("/a/b/n")
    assert process.command == (
        *("nice", "-n", "1", "sleep", "one", "two three", "2"),
        *("--ros-args", "--log-level", "debug", "--ros-args", "-r", "__node:=n", "-r", "__ns:=/a/b"),
        *("--params-file", "${run}/params/a.b.n.yaml", "-r", "x:=y", "-r", "chatter:=/talk"),
    )
    assert process.parameters == {"p": 1, "q": True}
    assert process.remappings == (("x", "y"), ("chatter", "/talk"))


@pytest.mark.conforms("4.4 none at all", "4.5 --ros-args")
@pytest.mark.parametrize(
    ("node", "identity", "words"),
    [
        ("{exec: sleep}", "/sleep", ("sleep", "--ros-args")),
        ("{exec: sleep, exec_name: label}", "/label", ("sleep", "--ros-args")),
        ("{exec: sleep, namespace: /}", "/sleep", ("sleep", "--ros-args", "-r", "__ns:=/")),
        ("{exec: sleep, name: /n}", "/n", ("sleep", "--ros-args", "-r", "__node:=n")),
    ],
)
def test_nodes_without_a_name_or_namespace(
    node: str, identity: str, words: tuple[str, ...], tmp_path: Path
) -> None:
    (process,) = outcome(tmp_path, f"launch:\n- node: {node}").plan.processes
    assert (process.id, process.command) == (identity, words)


@pytest.mark.conforms("D53")
def test_repeats_are_told_apart_in_plan_order(tmp_path: Path) -> None:
    text = "launch:\n- executable: {cmd: sleep 1}\n- executable: {cmd: sleep 2}\n- executable: {cmd: /bin/sleep 3, name: x}"
    assert [process.id for process in outcome(tmp_path, text).plan.processes] == ["sleep", "sleep#2", "x"]


def test_a_name_like_a_repeat_is_kept_apart_too(tmp_path: Path) -> None:
    text = "launch:\n" + "".join(
        f"- executable: {{cmd: x, name: {name}}}\n" for name in ("a", "a#2", "a", "a#3", "a")
    )
    found = outcome(tmp_path, text)
    assert [process.id for process in found.plan.processes] == ["a", "a#2", "a#3", "a#3#2", "a#4"]


@pytest.mark.conforms("D74")
def test_two_nodes_with_one_name_are_refused_where_the_second_is(tmp_path: Path) -> None:
    text = "launch:\n- node: {exec: a, name: n}\n- push_ros_namespace: {namespace: /}\n- node: {exec: b, name: n}"
    assert outcome(tmp_path, text).faults == [(Code.DUPLICATE_NODE, "main.yaml", 4, 25)]


def test_nodes_of_two_ros_domains_may_have_one_name(tmp_path: Path) -> None:
    def group(domain: str, actions: str) -> str:
        return f"- group: [{{set_env: {{name: ROS_DOMAIN_ID, value: '{domain}'}}}}, {actions}]\n"

    node, own = (
        "{node: {exec: a, name: n}}",
        "{node: {exec: a, name: n, env: [{name: ROS_DOMAIN_ID, value: '3'}]}}",
    )
    apart = f"launch:\n- node: {{exec: a, name: n}}\n{group('1', node)}{group('2', f'{node}, {own}')}"
    assert outcome(tmp_path, apart).faults == []
    assert outcome(tmp_path, apart + group("1", node)).faults == [(Code.DUPLICATE_NODE, "main.yaml", 5, 80)]


def test_components_are_in_the_domain_of_their_container(tmp_path: Path) -> None:
    def container(name: str, domain: str) -> str:
        component = "{pkg: p, plugin: 'p::A', name: n}"
        keys = (
            f"pkg: c, exec: component_container, name: {name}, namespace: '', composable_node: [{component}]"
        )
        return f"- node_container: {{{keys}, env: [{{name: ROS_DOMAIN_ID, value: '{domain}'}}]}}\n"

    def told(text: str) -> list[Code]:
        return [found.code for found in outcome(tmp_path, f"launch:\n{text}").problems]

    load = "- load_composable_node: {target: %s, composable_node: [{pkg: p, plugin: 'p::A', name: n}]}\n"
    assert Code.DUPLICATE_NODE not in told(container("one", "1") + container("two", "2"))
    assert Code.DUPLICATE_NODE in told(container("one", "1") + container("two", "1"))
    assert Code.DUPLICATE_NODE in told(container("one", "1") + load % "one")
    assert Code.DUPLICATE_NODE not in told(container("one", "1") + load % "elsewhere")


def test_publishers_of_static_transforms_may_have_one_name(tmp_path: Path) -> None:
    node = "- node: {pkg: tf2_ros, exec: static_transform_publisher, name: n}\n"
    problems = outcome(tmp_path, f"launch:\n{node}{node}").problems
    assert [(found.code, found.severity) for found in problems if found.code is Code.DUPLICATE_NODE] == [
        (Code.DUPLICATE_NODE, Severity.WARNING)
    ]


PARAMETERS: dict[str, tuple[str, dict[str, str], dict[str, object]]] = {
    "inline values keep their types": (
        "[{name: a, value: 1}, {name: b, value: 1.5}, {name: c, value: 'yes'}, {name: d, value: yes}, "
        "{name: e, value: [1, 2]}, {name: f, value: text}, {name: g, value: 1.0}]",
        {},
        {"a": 1, "b": 1.5, "c": "yes", "d": True, "e": (1, 2), "f": "text", "g": 1.0},
    ),
    "a substitution is typed by what it comes to": (
        "[{name: a, value: $(eval 2*3)}, {name: b, value: '$(eval 2*3)', type: str}, {name: c, value: $(var n)}]",
        {},
        {"a": 6, "b": "6", "c": True},
    ),
    "nested names are joined": (
        "[{name: a, param: [{name: b, value: 1}, {name: c, param: [{name: d, value: 2}]}]}, {name: a, value: 0}]",
        {},
        {"a.b": 1, "a.c.d": 2, "a": 0},
    ),
    "a later one wins": ("[{name: a, value: 1}, {name: a, value: 2}]", {}, {"a": 2}),
    "files by wildcard, namespace and name": (
        "[{from: p.yaml}]",
        {
            "p.yaml": "/**: {ros__parameters: {a: 1, b: 1}}\nns: {n: {ros__parameters: {b: 2}}}\nother: {ros__parameters: {c: 3}}"
        },
        {"a": 1, "b": 2},
    ),
    "a wildcard that comes first loses to an exact key even where it comes again": (
        "[{from: p.yaml}, {name: a, value: 2}, {from: p.yaml}]",
        {"p.yaml": "/**: {ros__parameters: {a: 1}}"},
        {"a": 2},
    ),
    "a file with substitutions": (
        "[{from: p.yaml, allow_substs: true}]",
        {"p.yaml": '/**: {ros__parameters: {a: $(var n), b: "$(dirname)"}}'},
        {"a": True},
    ),
}


@pytest.mark.conforms("4.5 precedence of parameters", "4.6.5 order of patterns")
@pytest.mark.parametrize("case", PARAMETERS)
def test_effective_parameters_of_a_node(case: str, tmp_path: Path) -> None:
    written, files, parameters = PARAMETERS[case]
    main = f"launch:\n- let: {{name: n, value: 'true'}}\n- node: {{exec: a, name: n, namespace: ns, param: {written}}}"
    process = outcome(tmp_path, {"main.yaml": main, **files}).process("/ns/n")
    found = dict(process.parameters)
    if "b" not in parameters:
        found.pop("b", None)
    assert found == parameters
    assert [type(value) for value in found.values()] == [type(value) for value in parameters.values()]


@pytest.mark.conforms("D68")
def test_a_value_that_stands_last_and_loses_is_a_warning(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- node: {exec: a, name: n, namespace: ns, param: [{name: a, value: 2}, {from: p.yaml}]}\n",
        "p.yaml": "/**: {ros__parameters: {z: 0}}\n/ns/n: {ros__parameters: {a: 2}}\n/**/n: {ros__parameters: {a: 1}}\n"
        "/ns/*: {ros__parameters: {b: 1}}\n",
    }
    found = outcome(tmp_path, files)
    assert found.process("/ns/n").parameters["a"] == 1
    assert [fault[0] for fault in found.faults] == [Code.DUPLICATE_PARAMETER]  # the file says it twice
    again = files["main.yaml"].replace("{from: p.yaml}]", "{from: p.yaml}, {name: a, value: 3}]")
    warned = outcome(tmp_path, {**files, "main.yaml": again})
    assert warned.process("/ns/n").parameters["a"] == 1
    assert [fault[0] for fault in warned.faults] == [Code.DUPLICATE_PARAMETER, Code.OVERRULED_PARAMETER]


def test_the_command_line_wins_over_all(tmp_path: Path) -> None:
    (tmp_path / "over.yaml").write_text("/**: {ros__parameters: {a: 10, c: 10}}\n")
    text = "launch:\n- node: {exec: a, name: n, namespace: ns, param: [{name: a, value: 1}, {name: b, value: 1}, {name: c, value: 1}]}"
    found = outcome(
        tmp_path, text, "/ns/n:c:=20", "ns/n:d:=[x, z]", params_files=(str(tmp_path / "over.yaml"),)
    )
    assert found.process("/ns/n").parameters == {"a": 10, "b": 1, "c": 20, "d": ("x", "z")}
    assert list(found.problems) == []


def test_a_parameter_for_a_node_that_is_not_there(tmp_path: Path) -> None:
    (problem,) = outcome(tmp_path, "launch:\n- node: {exec: a, name: talker}", "/taler:c:=20").problems
    assert (problem.code, problem.suggestion) == (Code.UNMATCHED_SECTION, "/talker")


@pytest.mark.conforms("D19", "4.6.3 files given by path")
def test_sections_for_other_nodes_are_passed_on_before_the_nodes_own(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- node: {exec: a, name: n, namespace: ns, param: [{from: p.yaml}, {name: own, value: 1}]}",
        "p.yaml": "/**: {ros__parameters: {a: 1}}\n/ns/n: {ros__parameters: {b: 2}}\n/inner: {ros__parameters: {c: 3}}",
    }
    process = outcome(tmp_path, files).process("/ns/n")
    assert contents(process) == {
        "${run}/params/ns.n.yaml": "/**:\n  ros__parameters:\n    a: 1\n/inner:\n  ros__parameters:\n    c: 3\n"
        "/ns/n:\n  ros__parameters:\n    a: 1\n    b: 2\n    own: 1\n"
    }


@pytest.mark.parametrize(
    ("node", "patterns"),
    [
        ("name: n, namespace: ns", ["/**", "/inner", "/ns/n"]),
        ("name: n", ["/**", "/inner", "/ns/n", "/other/n"]),
        ("output: log", ["/**", "/inner", "/ns/n", "/other/n", "/other/m"]),
    ],
)
def test_sections_for_nodes_of_other_processes_are_not_passed_on(
    node: str, patterns: list[str], tmp_path: Path
) -> None:
    """A node whose namespace is not known may be any of its name, one without a name any at all."""
    others = "".join(f"- node: {{exec: b, name: {name}, namespace: other}}\n" for name in "nm")
    files = {
        "main.yaml": f"launch:\n- node: {{exec: a, {node}, param: [{{from: p.yaml}}]}}\n{others}",
        "p.yaml": "".join(
            f"{pattern}: {{ros__parameters: {{x: 1}}}}\n"
            for pattern in ("/**", "/inner", "/ns/n", "/other/n", "/other/m")
        ),
    }
    first, *_ = outcome(tmp_path, files).plan.processes
    lines = "".join(contents(first).values()).splitlines()
    assert [line.removesuffix(":") for line in lines if line.startswith("/")] == patterns


def test_a_node_whose_name_is_not_known_gets_all_sections_in_order(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- node: {exec: a, param: [{from: p.yaml}, {name: own, value: 1}]}",
        "p.yaml": "/x: {ros__parameters: {c: 3}}\n/**: {ros__parameters: {a: 1}}\n",
    }
    process = outcome(tmp_path, files).process("/a")
    assert process.parameters == {"a": 1, "own": 1}
    assert contents(process) == {
        "${run}/params/a.yaml": "/x:\n  ros__parameters:\n    c: 3\n/**:\n  ros__parameters:\n    a: 1\n    own: 1\n"
    }


def test_a_parameter_file_with_nothing_for_the_node_is_a_warning(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- node: {exec: a, name: n, namespace: ns, param: [{from: p.yaml}]}",
        "p.yaml": "/n: {ros__parameters: {c: 3}}",
    }
    assert [fault[0] for fault in outcome(tmp_path, files).faults] == [Code.UNMATCHED_SECTION]


@pytest.mark.conforms("D18")
def test_a_missing_parameter_file_is_an_error_with_a_near_name(tmp_path: Path) -> None:
    files = {"main.yaml": "launch:\n- node: {exec: a, param: [{from: parms.yaml}]}", "params.yaml": ""}
    (problem,) = outcome(tmp_path, files).problems
    assert (problem.code, problem.suggestion) == (Code.MISSING_FILE, "params.yaml")


@pytest.mark.conforms("D23")
def test_a_rule_that_is_never_reached_is_a_warning(tmp_path: Path) -> None:
    text = "launch:\n- set_remap: {from: a, to: b}\n- node: {exec: x, name: n, namespace: /, remap: [{from: /a, to: c}]}"
    assert [fault[:3] for fault in outcome(tmp_path, text).faults] == [(Code.DEAD_REMAP, "main.yaml", 3)]


READY = "launch:\n- node: {exec: a, name: s, namespace: /w, ready: {message: clock, timeout: 3}, remap: [{from: clock, to: /time}]}\n"


def test_readiness_and_dependencies_are_named_as_the_node_sees_them(tmp_path: Path) -> None:
    text = READY + (
        "- node: {exec: a, name: r, namespace: w, depends_on: [{node: s, condition: ready, timeout: 5}, "
        "{node: /w/s}]}\n"
    )
    found = outcome(tmp_path, text)
    ready = found.process("/w/s").ready
    assert ready is not None
    assert (ready.message, ready.log, ready.timeout) == ("/time", None, 3.0)
    edges = found.process("/w/r").depends_on
    assert [(edge.process, edge.condition, edge.timeout) for edge in edges] == [
        ("/w/s", "ready", 5.0),
        ("/w/s", "started", None),
    ]


def test_a_label_stands_for_every_process_of_an_include(tmp_path: Path) -> None:
    files = {
        "main.yaml": "launch:\n- include: {file: b.yaml, label: base}\n"
        "- executable: {cmd: x, depends_on: [{label: base, condition: exited}]}",
        "b.yaml": "launch:\n- executable: {cmd: y}\n- executable: {cmd: z}",
    }
    edges = outcome(tmp_path, files).process("x").depends_on
    assert [(edge.process, edge.condition) for edge in edges] == [("y", "exited"), ("z", "exited")]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        (READY + "- executable: {cmd: b, depends_on: [{node: /w/t}]}", Code.UNKNOWN_DEPENDENCY),
        (
            "launch:\n- executable: {cmd: a}\n- executable: {cmd: b, depends_on: [{process: a, condition: ready}]}",
            Code.NEVER_READY,
        ),
        (
            "launch:\n- executable: {cmd: a, depends_on: [{process: b}]}\n- executable: {cmd: b, depends_on: [{process: a}]}",
            Code.DEPENDENCY_CYCLE,
        ),
        ("launch:\n- executable: {cmd: a, depends_on: [{process: a}]}", Code.DEPENDENCY_CYCLE),
        ("launch:\n- executable: {cmd: a, ready: {log: '('}}", Code.BAD_VALUE),
        ("launch:\n- executable: {cmd: a, stop: {signal: INTT}}", Code.BAD_VALUE),
        ("launch:\n- executable: {cmd: ./nothing/there}", Code.MISSING_EXECUTABLE),
        ("launch:\n- node: {pkg: bringup, exec: ekff}", Code.MISSING_EXECUTABLE),
        ("launch:\n- node: {pkg: brinup, exec: ekf}", Code.MISSING_PACKAGE),
        ("launch:\n- node: {exec: a, name: 0n}", Code.BAD_NAME),
        ("launch:\n- node: {exec: a, namespace: a b}", Code.BAD_NAME),
        ("launch:\n- node: {exec: a, remap: [{from: a b, to: c}]}", Code.BAD_NAME),
        ("launch:\n- node: {exec: a, param: [{name: x, value: [1, a]}]}", Code.PARAMETER_TYPE),
        ("launch:\n- node: {exec: a, param: [{name: x, value: []}]}", Code.PARAMETER_TYPE),
    ],
)
def test_what_cannot_work_is_refused_once(text: str, code: Code, tmp_path: Path) -> None:
    assert [problem.code for problem in outcome(tmp_path, text).problems] == [code]


def test_a_dependency_on_a_faulty_action_is_not_reported_too(tmp_path: Path) -> None:
    text = "launch:\n- ndoe: {exec: a, name: s}\n- executable: {cmd: b, depends_on: [{node: /s}]}"
    assert [problem.code for problem in outcome(tmp_path, text).problems] == [Code.UNKNOWN_ACTION]


POLICIES = """launch:
- executable: {cmd: a, respawn: true, respawn_delay: 2, respawn_max_retries: 3, sigterm_timeout: 4.5}
- executable: {cmd: b, restart: {policy: on-failure, delay: 1, budget: 2}, stop: {signal: TERM, kill_timeout: 1}}
- executable: {cmd: c, on_exit: shutdown, success_exit_codes: [0, 3], output: log, cwd: /var, shell: true}
"""


@pytest.mark.conforms("1.3.2 respawn", "1.3.2 respawn_max_retries")
def test_policies_come_from_upstreams_keys_and_orchestras(tmp_path: Path) -> None:
    found = outcome(tmp_path, POLICIES)
    a, b, c = found.plan.processes
    assert a.restart is not None
    assert b.restart is not None
    assert (a.restart.policy, a.restart.delay, a.restart.max_delay, a.restart.budget) == (
        "always",
        2.0,
        30.0,
        3,
    )
    assert a.stop is not None
    assert b.stop is not None
    assert (a.stop.signal, a.stop.timeout) == ("SIGINT", 4.5)
    assert (b.restart.policy, b.restart.budget, b.stop.signal, b.stop.kill_timeout) == (
        "on-failure",
        2,
        "SIGTERM",
        1.0,
    )
    assert (c.required, c.success_exit_codes, c.output, c.cwd, c.shell) == (True, (0, 3), "log", "/var", True)
    assert [(trigger.on.event, trigger.on.target) for trigger in found.plan.triggers] == [
        ("process_exited", "c")
    ]


def test_a_plan_survives_its_json(tmp_path: Path) -> None:
    plan = outcome(tmp_path, POLICIES + READY.removeprefix("launch:\n")).plan
    assert loads(dumps(plan)) == plan


def test_planning_twice_gives_the_same_bytes(tmp_path: Path) -> None:
    text = READY + "- node: {exec: $(anon a), name: $(anon b), param: [{name: x, value: $(anon c)}]}"
    assert dumps(outcome(tmp_path, text).plan) == dumps(outcome(tmp_path, text).plan)


def test_actions_that_a_condition_left_out_are_in_the_plan(tmp_path: Path) -> None:
    text = "launch:\n- arg: {name: gui, default: 'no'}\n- node: {exec: a, name: view, if: $(var gui)}"
    (skipped,) = outcome(tmp_path, text).plan.skipped
    assert (skipped.action, skipped.name, skipped.condition, skipped.expression, skipped.value) == (
        *("node", "view", "if", "$(var gui)", "no"),
    )


def test_the_digest_covers_what_makes_a_process_another_one(tmp_path: Path) -> None:
    def digest(node: str) -> str:
        return outcome(tmp_path, f"launch:\n- node: {{exec: a, name: n, {node}}}").plan.processes[0].digest

    same = digest("output: log")
    assert digest("output: screen, required: true") == same
    others = [
        "args: x",
        "cwd: /var",
        "env: [{name: A, value: b}]",
        "env_only: []",
        "param: [{name: x, value: 1}]",
        "shell: true",
    ]
    assert len({same, *(digest(other) for other in others)}) == len(others) + 1


def test_every_field_of_the_specification_is_in_the_json(tmp_path: Path) -> None:
    document = json.loads(dumps(outcome(tmp_path, POLICIES).plan))
    assert list(document) == [
        *("version", "file", "arguments", "processes", "components", "triggers", "skipped", "problems"),
    ]
    assert set(document["processes"][0]) == {
        *(
            "id",
            "kind",
            "package",
            "executable",
            "name",
            "namespace",
            "command",
            "shell",
            "prefix",
            "environment",
            "inherit_environment",
        ),
        *(
            "cwd",
            "parameters",
            "parameter_files",
            "remappings",
            "arguments",
            "output",
            "emulate_tty",
            "stdin",
        ),
        *(
            "restart",
            "required",
            "success_exit_codes",
            "ready",
            "alive",
            "lifecycle",
            "depends_on",
            "stop",
            "limits",
        ),
        *("warm", "machine", "digest", "location", "provenance", "params_schema"),
    }

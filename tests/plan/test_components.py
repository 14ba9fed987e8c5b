"""Containers and components: what is loaded into which process, with what, and when."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.description.actions.lifecycle_node import LifecycleNode
from orchestra.description.actions.load_composable_node import LoadComposableNode
from orchestra.description.actions.node_container import NodeContainer
from orchestra.description.actions.push_ros_namespace import PushRosNamespace
from orchestra.description.components import ComposableNode
from orchestra.description.text import Opaque, Template
from orchestra.errors import Code, Severity
from orchestra.plan.codec import dumps, loads
from orchestra.plan.reactions import LoadAction
from tests.resolve.launching import outcome
from tests.resolve.made import AT, planned, text

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Component

_CONTAINER = "{exec: sleep, name: box, namespace: '', composable_node: [COMPONENTS]}"


def _components(
    folder: Path, written: str, before: str = "", files: dict[str, str] | None = None
) -> Component:
    main = f"launch:\n{before}- node_container: {_CONTAINER.replace('COMPONENTS', written)}"
    found = outcome(folder, {"main.yaml": main, **(files or {})})
    assert not found.problems.errors
    (component,) = found.plan.components
    return component


@pytest.mark.conforms("4.7 order", "4.7 request")
def test_components_of_a_container_are_loaded_with_its_start_in_order(tmp_path: Path) -> None:
    written = """launch:
- push_ros_namespace: {namespace: r}
- set_remap: {from: a, to: b}
- node_container:
    exec: sleep
    name: box
    namespace: c
    remap: [{from: x, to: y}]
    composable_node:
    - {pkg: image, plugin: "image::Camera", name: cam, remap: [{from: p, to: q}]}
    - {pkg: image, plugin: "image::View", name: view, namespace: d}
    - {pkg: image, plugin: "image::View", namespace: /e}
    - {pkg: image, plugin: "image::View", if: "false"}
"""
    found = outcome(tmp_path, written)
    assert list(found.problems) == []
    plan = found.plan
    (container,) = plan.processes
    assert (container.id, container.kind) == ("/r/c/box", "container")
    assert container.remappings == (("a", "b"), ("x", "y"))
    assert [(item.id, item.name, item.namespace) for item in plan.components] == [
        ("/r/cam", "cam", "/r"),
        ("/r/d/view", "view", "/r/d"),
        ("/e/View", None, "/e"),
    ]
    camera = plan.components[0]
    assert (camera.container, camera.process, camera.condition) == ("/r/c/box", "/r/c/box", "started")
    assert camera.remappings == (("a", "b"), ("p", "q"))
    assert [(item.action, item.expression) for item in plan.skipped] == [("composable_node", "false")]
    assert dumps(loads(dumps(plan))) == dumps(plan)


def test_a_component_without_a_namespace_has_none(tmp_path: Path) -> None:
    component = _components(tmp_path, "{pkg: p, plugin: 'p::C', name: c}")
    assert (component.id, component.namespace) == ("/c", None)


def test_repeats_are_told_apart_from_processes_too(tmp_path: Path) -> None:
    component = _components(tmp_path, "{pkg: p, plugin: 'p::C', name: box}")
    assert component.id == "/box#2"


FILE = """/**:
  ros__parameters: {x: all, y: all, z: 1.0}
/*:
  ros__parameters: {w: wild}
/c:
  ros__parameters: {y: own}
/other:
  ros__parameters: {v: 1}
"""

PARAMETERS = {
    "a file counts by rcl's own matching": (
        "[{from: p.yaml}]",
        "",
        {"x": "all", "y": "own", "z": 1.0, "w": "wild"},
    ),
    "what stands later counts": (
        "[{name: x, value: 1}, {from: p.yaml}, {name: y, value: 2}]",
        "",
        {"x": "all", "y": 2, "z": 1.0, "w": "wild"},
    ),
    "what is for all nodes stands first": (
        "[{name: x, value: 1}]",
        "- set_parameters_from_file: {filename: p.yaml}\n- set_parameter: {name: z, value: 2}\n",
        {"x": 1, "y": "own", "z": 2, "w": "wild"},
    ),
    "a file may have nothing but parameters": (
        "[{from: plain.yaml}]",
        "",
        {"a": 1, "b.c": "text", "l": (1.5, 2.0)},
    ),
    "with substitutions": (
        "[{from: substituted.yaml, allow_substs: true}]",
        "- let: {name: v, value: '7'}\n",
        {"a": 7},
    ),
}


@pytest.mark.conforms("4.7 parameters")
@pytest.mark.parametrize("case", PARAMETERS)
def test_the_parameters_of_a_component(case: str, tmp_path: Path) -> None:
    written, before, expected = PARAMETERS[case]
    files = {
        "p.yaml": FILE,
        "plain.yaml": "# a comment\na: 1\nb: {c: text}\nl: [1.5, 2.0]\n",
        "substituted.yaml": "/**: {ros__parameters: {a: $(var v)}}",
    }
    component = _components(tmp_path, f"{{pkg: p, plugin: C, name: c, param: {written}}}", before, files)
    assert component.parameters == expected
    winners = {
        name: [item.value for item in written if item.won]
        for name, written in component.provenance.parameters.items()
    }
    assert winners == {name: [value] for name, value in expected.items()}


def test_where_the_name_is_not_known_only_what_is_for_all_counts(tmp_path: Path) -> None:
    component = _components(tmp_path, "{pkg: p, plugin: C, param: [{from: p.yaml}]}", "", {"p.yaml": FILE})
    assert component.parameters == {"x": "all", "y": "all", "z": 1.0}


def test_the_command_line_wins(tmp_path: Path) -> None:
    main = "launch:\n- node_container: " + _CONTAINER.replace(
        "COMPONENTS", "{pkg: p, plugin: C, name: c, param: [{name: a, value: 1}]}"
    )
    found = outcome(tmp_path, main, "/c:a:=2", "c:b:=x")
    assert list(found.problems) == []
    assert found.plan.components[0].parameters == {"a": 2, "b": "x"}


@pytest.mark.conforms("4.7 extra_arguments")
@pytest.mark.parametrize(
    ("written", "value"),
    [("true", True), ("'true'", True), ("$(var flag)", True), ("[1, 2]", (1, 2)), ("text", "text")],
)
def test_extra_arguments_have_types(written: str, value: object, tmp_path: Path) -> None:
    extra = f"extra_arg: [{{name: use_intra_process_comms, value: {written}}}]"
    before = "- let: {name: flag, value: 'true'}\n"
    component = _components(tmp_path, f"{{pkg: p, plugin: C, {extra}}}", before)
    assert component.extra_arguments == {"use_intra_process_comms": value}


LOADED = "composable_node: [{pkg: p, plugin: C, name: c, autostart: true}]"


@pytest.mark.conforms("4.7 target")
@pytest.mark.parametrize("target", ["/r/box", "r/box", "$(var name)"])
def test_components_find_their_container_wherever_it_stands(target: str, tmp_path: Path) -> None:
    written = f"""launch:
- let: {{name: name, value: /r/box}}
- load_composable_node: {{target: {target}, {LOADED}}}
- node: {{exec: sleep, name: box, namespace: r}}
"""
    found = outcome(tmp_path, written)
    assert list(found.problems) == []
    (component,) = found.plan.components
    assert (component.container, component.process) == ("/r/box", "/r/box")
    assert (component.condition, component.lifecycle) == ("started", "active")


def test_a_timer_loads_what_stands_in_it(tmp_path: Path) -> None:
    written = f"""launch:
- timer:
    period: 2.0
    children:
    - node_container: {{exec: sleep, name: box, namespace: '', composable_node: [{{pkg: p, plugin: C, name: a}}]}}
    - load_composable_node: {{target: /box, {LOADED}}}
"""
    found = outcome(tmp_path, written)
    assert list(found.problems) == []
    assert [(item.id, item.condition) for item in found.plan.components] == [
        ("/a", "started"),
        ("/c", "event"),
    ]
    (trigger,) = found.plan.triggers
    assert [action.action for action in trigger.do] == ["start", "load"]
    assert [action.component for action in trigger.do if isinstance(action, LoadAction)] == ["/c"]


def test_a_container_that_is_nowhere_may_be_of_another_launch(tmp_path: Path) -> None:
    written = f"""launch:
- node_container: {{exec: sleep, name: container, namespace: ''}}
- load_composable_node: {{target: /contaner, {LOADED}}}
"""
    found = outcome(tmp_path, written)
    (problem,) = found.problems
    assert problem.severity is Severity.WARNING
    assert (problem.code, problem.suggestion) == (Code.UNKNOWN_DEPENDENCY, "/container")
    assert found.plan.components[0].process is None


@pytest.mark.parametrize("other", ["node: {exec: sleep, name: gain}", "let: {name: a, value: b}"])
def test_where_nothing_is_a_container_another_launch_starts_it(other: str, tmp_path: Path) -> None:
    found = outcome(tmp_path, f"launch:\n- {other}\n- load_composable_node: {{target: /box, {LOADED}}}\n")
    assert [(item.severity, item.code) for item in found.problems] == [
        (Severity.NOTE, Code.UNKNOWN_DEPENDENCY)
    ]


MISTAKES = {
    "node_container: {exec: sleep, namespace: ''}": Code.MISSING_KEY,
    "node_container: {exec: sleep, name: box}": Code.MISSING_KEY,
    "lifecycle_node: {exec: sleep, name: box}": Code.MISSING_KEY,
    "load_composable_node: {target: /box}": Code.MISSING_KEY,
    "load_composable_node: {target: /box, composable_node: [{pkg: p}]}": Code.MISSING_KEY,
    f"load_composable_node: {{target: '', {LOADED}}}": Code.BAD_NAME,
    f"load_composable_node: {{target: /a//b, {LOADED}}}": Code.BAD_NAME,
    "load_composable_node: {target: /b, composable_node: [{pkg: p, plugin: C, name: a b}]}": Code.BAD_NAME,
    "load_composable_node: {target: /b, composable_node: [{pkg: p, plugin: C, if: maybe}]}": Code.WRONG_TYPE,
    "load_composable_node: {target: /b, composable_node: [{pkg: p, plugin: C, if: 'true', unless: 'true'}]}": (
        Code.CONFLICTING_KEYS
    ),
}


@pytest.mark.parametrize("action", MISTAKES)
def test_mistakes_are_told_once_at_their_place(action: str, tmp_path: Path) -> None:
    found = outcome(tmp_path, f"launch:\n- {action}")
    (problem,) = found.problems.errors
    assert problem.code == MISTAKES[action]
    assert problem.span is not None
    assert problem.span.line == 2


def _load(target: object) -> LoadComposableNode:
    component = ComposableNode.at(AT, pkg=text("p"), plugin=text("C"), name=text("c"))
    named = Template((Opaque(target, AT),), "the container", AT)
    return LoadComposableNode.at(AT, target=named, composable_node=(component,))


@pytest.mark.conforms("4.7 target")
def test_python_names_a_container_by_its_action() -> None:
    origin = object()
    container = NodeContainer.at(AT, origin=origin, exec=text("sleep"), name=text("box"), namespace=None)
    plan, problems = planned(_load(origin), container)
    assert list(problems) == []
    assert [(item.container, item.process) for item in plan.components] == [("/box", "/box")]


def test_an_action_that_starts_nothing_is_no_container() -> None:
    _, problems = planned(_load(object()))
    assert [problem.code for problem in problems.errors] == [Code.UNKNOWN_DEPENDENCY]


@pytest.mark.conforms("4.11 LifecycleNode")
def test_a_life_cycle_node_needs_its_full_name() -> None:
    node = LifecycleNode.at(AT, exec=text("sleep"), name=text("a"), namespace=None)
    _, problems = planned(node)
    assert [(problem.code, problem.span) for problem in problems] == [(Code.BAD_NAME, AT)]
    _, problems = planned(PushRosNamespace.at(AT, namespace=text("ns")), node)
    assert list(problems) == []


@pytest.mark.conforms("4.11 autostart", "4.11 front ends", "D40")
def test_a_life_cycle_node_can_be_started_by_itself(tmp_path: Path) -> None:
    written = """launch:
- lifecycle_node: {exec: sleep, name: a, namespace: '', autostart: true}
- lifecycle_node: {exec: sleep, name: b, namespace: ns}
"""
    one, other = outcome(tmp_path, written).plan.processes
    assert (one.id, one.kind, one.lifecycle) == ("/a", "lifecycle_node", "active")
    assert (other.id, other.kind, other.lifecycle) == ("/ns/b", "lifecycle_node", None)
    assert other.command == ("sleep", "--ros-args", "-r", "__node:=b", "-r", "__ns:=/ns")

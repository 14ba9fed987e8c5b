"""Checks of a plan as a whole: a row for each wrong case, and one for each that looks like it and is right."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from tests.plan.checks.told import Told, node, told

if TYPE_CHECKING:
    from pathlib import Path


def _to(target: str) -> str:
    return f"[{{from: x, to: {target}}}]"


def _container(*components: str) -> str:
    return f"- node_container: {{exec: sleep, name: box, namespace: '', composable_node: [{', '.join(components)}]}}\n"


WRONG: dict[str, tuple[str, list[Told]]] = {
    # Waits.
    "the end of what is always started again": (
        node("a", respawn="true") + node("b", depends_on="[{node: a, condition: completed}]"),
        [(Code.NEVER_READY, "a", None)],
    ),
    "its end however it ends": (
        node("a", restart="always") + node("b", depends_on="[{node: a, condition: exited}]"),
        [(Code.NEVER_READY, "a", None)],
    ),
    "a node that its condition leaves out": (
        node("a", **{"if": "false"}) + node("b", depends_on="[{node: a}]"),
        [(Code.UNKNOWN_DEPENDENCY, "a", None)],
    ),
    "readiness of a node under a misspelt name": (
        node("talker", ready="{node: /tlaker}"),
        [(Code.UNKNOWN_DEPENDENCY, "/tlaker", "/talker")],
    ),
    "readiness of a node in another namespace": (
        node("talker", namespace="ns") + node("b", ready="{lifecycle: {node: /talker, state: active}}"),
        [(Code.UNKNOWN_DEPENDENCY, "/talker", "/ns/talker")],
    ),
    "a parameter of a misspelt node": (
        node("talker") + node("b", ready="{parameter: {node: talkr, name: x}}"),
        [(Code.UNKNOWN_DEPENDENCY, "talkr", "/talker")],
    ),
    # Components.
    "two components of one plugin without a name": (
        _container("{pkg: p, plugin: A}", "{pkg: p, plugin: B}", "{pkg: p, plugin: A}"),
        [(Code.DUPLICATE_NODE, "{", None)],
    ),
    # Parameters that are set twice.
    "a parameter twice in one list": (
        node("a", param="[{name: x, value: 1}, {name: x, value: 2}]"),
        [(Code.DUPLICATE_PARAMETER, "x", None)],
    ),
    # Topics.
    "two names that differ in case": (
        node("a", remap=_to("/Scan")) + node("b", remap=_to("/scan")),
        [(Code.SPLIT_TOPIC, "/scan", "/Scan")],
    ),
    "two names that differ in where a slash stands": (
        node("a", remap=_to("/front/image")) + node("b", remap=_to("/frontimage")),
        [(Code.SPLIT_TOPIC, "/frontimage", "/front/image")],
    ),
    "one name in a namespace and one in the root": (
        node("a", namespace="r", remap=_to("cmd_vel")) + node("b", namespace="r", remap=_to("/cmd_vel")),
        [(Code.SPLIT_TOPIC, "/cmd_vel", "cmd_vel")],
    ),
    "names of several levels, in a namespace and in the root, of nodes in different namespaces": (
        node("a", remap=_to("/lidar/packets")) + node("b", namespace="r", remap=_to("lidar/packets")),
        [(Code.SPLIT_TOPIC, "lidar/packets", "/lidar/packets")],
    ),
    "a topic that is waited for under another case": (
        node("a", remap=_to("/front/scan")) + node("b", ready="{topic: /front/Scan}"),
        [(Code.SPLIT_TOPIC, "/front/Scan", "/front/scan")],
    ),
    "one against many": (
        node("a", remap=_to("/scan")) + node("b", remap=_to("/Scan")) + node("c", remap=_to("/scan")),
        [(Code.SPLIT_TOPIC, "/Scan", "/scan")],
    ),
    # Cores.
    "a core that is another's alone": (
        node("a", limits="{cores: [1], exclusive: true}") + node("b", limits="{cores: [0, 1]}"),
        [(Code.CONTESTED_CORE, "node", None)],
    ),
    "two that never yield": (
        node("a", limits="{cores: [1], scheduler: fifo, priority: 9}")
        + node("b", limits="{cores: [1], scheduler: fifo, priority: 9}"),
        [(Code.CONTESTED_CORE, "node", None)],
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_what_can_never_work_is_told_once(case: str, tmp_path: Path) -> None:
    actions, faults = WRONG[case]
    assert told(tmp_path, actions) == faults


RIGHT: dict[str, str] = {
    "names of several levels of two robots, and one of none": node("a", remap=_to("/lidar/packets"))
    + node("b", namespace="r", remap=_to("lidar/packets"))
    + node("c", namespace="s", remap=_to("lidar/packets")),
    "names below those of nodes, which are theirs": node("a", remap=_to("/monitor/state"))
    + node("b", namespace="r", remap=_to("monitor/state"))
    + node("monitor", namespace="r"),
    "a name of one level in a namespace and in the root, of nodes in different namespaces": node(
        "a", remap=_to("/scan")
    )
    + node("b", namespace="r", remap=_to("scan")),
    "components without a name in namespaces, or renamed": _container(
        "{pkg: p, plugin: A}",
        "{pkg: p, plugin: A, namespace: x}",
        "{pkg: p, plugin: A, remap: [{from: __node, to: b}]}",
        "{pkg: p, plugin: A, name: c}",
    ),
    "the end of what has a budget": node("a", restart="{policy: always, budget: 2}")
    + node("b", depends_on="[{node: a, condition: completed}]"),
    "the end of what starts again after a failure": node("a", restart="on-failure")
    + node("b", depends_on="[{node: a, condition: completed}]"),
    "a wait that may be in vain": node("a", respawn="true")
    + node("b", depends_on="[{node: a, condition: completed, required: false}]"),
    "readiness of a node that somebody else starts": node("talker", ready="{node: /map_server}"),
    "a parameter twice with one value": node("a", param="[{name: x, value: 1}, {name: x, value: 1}]"),
    "a parameter for all nodes and for one": "- set_parameter: {name: x, value: 1}\n"
    + node("a", param="[{name: x, value: 2}]"),
    "two names that others use too": node("a", namespace="r", remap=_to("cmd_vel"))
    + node("b", namespace="r", remap=_to("cmd_vel"))
    + node("c", remap=_to("/cmd_vel"))
    + node("d", remap=_to("/cmd_vel")),
    "a name that is remapped to several": node("a", namespace="r", remap=_to("/t1"), ready="{topic: x}")
    + node("b", namespace="r", remap=_to("/t2"), ready="{topic: x}"),
    "names in two namespaces": node("a", namespace="r1", remap=_to("scan"))
    + node("b", namespace="r2", remap=_to("scan")),
    "transforms": node("a", namespace="r", remap="[{from: /tf, to: tf}]")
    + node("b", namespace="r", remap="[{from: tf, to: /tf}]"),
    "one node that uses both": node("a", remap="[{from: x, to: /scan}, {from: y, to: /Scan}]"),
    "cores of two, exclusive to none": node("a", limits="{cores: [1]}") + node("b", limits="{cores: [1]}"),
    "two that take turns": node("a", limits="{cores: [1], scheduler: rr, priority: 9}")
    + node("b", limits="{cores: [1], scheduler: rr, priority: 9}"),
    "two of different priority": node("a", limits="{cores: [1], scheduler: fifo, priority: 9}")
    + node("b", limits="{cores: [1], scheduler: fifo, priority: 8}"),
}


@pytest.mark.parametrize("case", RIGHT)
def test_what_only_looks_like_it_is_left_alone(case: str, tmp_path: Path) -> None:
    assert told(tmp_path, RIGHT[case]) == []


PARAMETERS = "/a:\n  ros__parameters: {x: 2}\n"


def test_a_value_before_a_file_that_has_another_one_does_not_count(tmp_path: Path) -> None:
    main = "launch:\n" + node("a", param="[{name: x, value: 1}, {from: p.yaml}]")
    found = told(tmp_path, {"main.launch.yaml": main, "p.yaml": PARAMETERS})
    assert found == [(Code.DUPLICATE_PARAMETER, "1", None)]


def test_a_file_is_there_to_be_overruled(tmp_path: Path) -> None:
    main = "launch:\n" + node("a", param="[{from: p.yaml}, {name: x, value: 1}]")
    assert told(tmp_path, {"main.launch.yaml": main, "p.yaml": PARAMETERS}) == []

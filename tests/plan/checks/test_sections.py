"""Sections of parameter files: those that miss their node are told at their key, foreign ones are left alone."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.errors import Code
from orchestra.plan.checks import sections
from orchestra.resolve.rcl.patterns import matches
from tests.plan.checks.told import Told, node, told

if TYPE_CHECKING:
    from pathlib import Path

_FILE = "[{from: p.yaml}]"
_CODE = Code.UNMATCHED_SECTION


def _section(pattern: str, name: str = "a") -> str:
    return f"{pattern}:\n  ros__parameters: {{{name}: 1}}\n"


# The actions, the file, what is told.
MISSED: dict[str, tuple[str, str, list[Told]]] = {
    "another namespace": (
        node("talker", namespace="ns", param=_FILE),
        _section("/talker"),
        [(_CODE, "/talker", "/**/talker")],
    ),
    "another namespace in nested keys": (
        node("talker", namespace="ns", param=_FILE),
        "other:\n  talker:\n    ros__parameters: {a: 1}\n",
        [(_CODE, "other", "ns")],
    ),
    "another namespace around the keys of two": (
        node("front", namespace="a/lidars", param=_FILE) + node("rear", namespace="a/lidars", param=_FILE),
        "/a:\n  lidar:\n    front:\n      ros__parameters: {a: 1}\n    rear:\n      ros__parameters: {a: 1}\n",
        [(_CODE, "lidar", "lidars")],
    ),
    "another namespace in braces": (
        node("talker", namespace="ns", param=_FILE),
        "other: {talker: {ros__parameters: {a: 1}}}\n",
        [(_CODE, "talker", None)],
    ),
    "a slip in the only section": (
        node("talker", param=_FILE),
        _section("/tlaker"),
        [(_CODE, "/tlaker", "/talker")],
    ),
    "a slip in a nested key": (
        node("talker", namespace="ns", param=_FILE),
        "ns:\n  tlaker:\n    ros__parameters: {a: 1}\n",
        [(_CODE, "tlaker", "talker")],
    ),
    "a slip beside a wildcard": (
        node("talker", param=_FILE),
        _section("/**") + _section("talkre"),
        [(_CODE, "talkre", "talker")],
    ),
    "a slip in a file for two": (
        node("talker", param=_FILE) + node("listener", param=_FILE),
        _section("talker") + _section("listner"),
        [(_CODE, "listner", "listener")],
    ),
    "an underscore too few": (
        node("map_server", param=_FILE),
        _section("/**") + _section("mapserver"),
        [(_CODE, "mapserver", "map_server")],
    ),
    "a section under no near name, alone in the file": (
        node("camera", param=_FILE),
        _section("usb_cam"),
        [(_CODE, "usb_cam", "camera")],
    ),
    "the only section of a file for two nodes": (
        node("front", param=_FILE) + node("rear", param=_FILE),
        _section("usb_cam"),
        [(_CODE, "usb_cam", "/**")],
    ),
    "a root section beside a wildcard, for a node in a namespace": (
        node("talker", namespace="ns", param=_FILE),
        _section("/**") + _section("talker"),
        [(_CODE, "talker", "/**/talker")],
    ),
    "its words in another order": (
        node("ekf_node_map", param=_FILE) + node("ekf_node_odom", param=_FILE),
        _section("ekf_node_odom") + _section("ekf_map_node"),
        [(_CODE, "ekf_map_node", "ekf_node_map")],
    ),
    "without the word node": (
        node("joy_node", param=_FILE) + node("teleop", param=_FILE),
        _section("joy") + _section("teleop"),
        [(_CODE, "joy", "joy_node")],
    ),
    "named after the program": (
        node("camera", param=_FILE) + node("teleop", param=_FILE),
        _section("/sleep") + _section("teleop"),
        [(_CODE, "/sleep", "/camera")],
    ),
    "the only one over, and the only node without one": (
        node("ekf_global", param=_FILE) + node("navsat", param=_FILE),
        _section("ekf_filter_node_map") + _section("navsat"),
        [(_CODE, "ekf_filter_node_map", "ekf_global")],
    ),
    "nothing near among several": (
        node("camera", param=_FILE),
        _section("usb_cam") + _section("lidar"),
        [(_CODE, "p.yaml", None)],
    ),
    "a file for all nodes of a scope": (
        "- set_parameters_from_file: {filename: p.yaml}\n" + node("talker"),
        _section("talkre"),
        [(_CODE, "talkre", "talker")],
    ),
    "a wildcard for one level": (
        node("talker", namespace="ns", param=_FILE),
        _section("/*"),
        [(_CODE, "/*", "/**")],
    ),
    "a wildcard for one level beside the node's own section": (
        node("talker", namespace="ns", param=_FILE) + node("listener", namespace="ns/inner", param=_FILE),
        _section("/ns/talker") + _section("/*/*/*/*"),
        [(_CODE, "/*/*/*/*", "/**")],
    ),
    "the wildcard of a namespace that is above that of the node": (
        node("talker", namespace="ns/inner", param=_FILE),
        _section("/ns/*"),
        [(_CODE, "/ns/*", "/ns/**")],
    ),
    "the wildcard of another namespace": (
        node("talker", namespace="robot1", param=_FILE),
        _section("/robot2/**"),
        [(_CODE, "/robot2/**", "/robot1/**")],
    ),
    "named after the program, in the node's namespace, beside a wildcard": (
        node("camera", namespace="ns", param=_FILE),
        _section("/**") + _section("/ns/sleep"),
        [(_CODE, "/ns/sleep", "/ns/camera")],
    ),
    "a letter of node is missing": (
        node("driver_node", param=_FILE) + node("other", param=_FILE),
        _section("/**") + _section("driver_nod"),
        [(_CODE, "driver_nod", "driver_node")],
    ),
    "a component": (
        "- node_container: {exec: sleep, name: c, namespace: '', composable_node: "
        "[{pkg: p, plugin: 'p::T', name: talker, param: [{from: p.yaml}]}]}\n",
        _section("tlaker"),
        [(_CODE, "tlaker", "talker")],
    ),
}


@pytest.mark.parametrize("case", MISSED)
def test_a_section_that_misses_its_node_is_told_where_it_stands(case: str, tmp_path: Path) -> None:
    actions, file, faults = MISSED[case]
    assert told(tmp_path, {"main.launch.yaml": f"launch:\n{actions}", "p.yaml": file}) == faults


FINE: dict[str, tuple[str, str]] = {
    "the name itself": (node("talker", param=_FILE), _section("talker")),
    "the full name": (node("talker", namespace="ns", param=_FILE), _section("/ns/talker")),
    "any namespace": (node("talker", namespace="ns", param=_FILE), _section("/**/talker")),
    "a relative full name": (node("talker", namespace="ns", param=_FILE), _section("ns/talker")),
    "sections for nodes that are not started": (
        node("amcl", param=_FILE),
        _section("amcl") + _section("map_server") + _section("amcl_map_client"),
    ),
    "a shared file with nothing for one of its nodes": (
        node("amcl", param=_FILE) + node("manager", param=_FILE),
        _section("amcl") + _section("planner"),
    ),
    "one over and two nodes without one": (
        node("ekf_map", param=_FILE) + node("ekf_odom", param=_FILE) + node("navsat", param=_FILE),
        _section("ekf_filter_node") + _section("navsat"),
    ),
    "two robots, one of them here": (
        node("ekf", namespace="robot1", param=_FILE),
        _section("/robot1/ekf") + _section("/robot2/ekf"),
    ),
    "another robot's section beside a wildcard": (
        node("ekf", namespace="robot1", param=_FILE),
        _section("/**") + _section("/robot2/ekf"),
    ),
    "near names that belong together": (
        node("front_lidar", param=_FILE) + node("camera1", param=_FILE),
        _section("/**") + _section("rear_lidar") + _section("camera2") + _section("camera_l"),
    ),
    "two sections with the same words": (
        node("joy_node", param=_FILE) + node("teleop", param=_FILE),
        _section("joy") + _section("joy_ros") + _section("teleop"),
    ),
    "the program's name beside a wildcard": (
        node("camera", param=_FILE),
        _section("/**") + _section("sleep"),
    ),
    "a wildcard for one level, where a node is there": (
        node("talker", param=_FILE) + node("listener", namespace="ns", param=_FILE),
        _section("/*") + _section("/**/listener"),
    ),
    "words of four letters and three": (
        node("left_arm", param=_FILE) + node("imu", param=_FILE),
        _section("/**") + _section("left_arms") + _section("left_army"),
    ),
    "a node whose name is not known": (
        "- node: {exec: sleep, param: [{from: p.yaml}]}\n",
        _section("talker"),
    ),
    "a container that is given what its components read": (
        "- node_container: {exec: sleep, name: c, namespace: '', param: [{from: p.yaml}], "
        "composable_node: [{pkg: p, plugin: 'p::T', name: talker, param: [{from: p.yaml}]}]}\n",
        _section("talker"),
    ),
    "a file for all nodes of a scope that is for one of them": (
        "- set_parameters_from_file: {filename: p.yaml}\n" + node("talker") + node("listener"),
        _section("talker"),
    ),
}


@pytest.mark.parametrize("case", FINE)
def test_sections_that_may_be_for_others_are_left_alone(case: str, tmp_path: Path) -> None:
    actions, file = FINE[case]
    assert told(tmp_path, {"main.launch.yaml": f"launch:\n{actions}", "p.yaml": file}) == []


def test_a_section_that_two_robots_miss_is_told_once(tmp_path: Path) -> None:
    files = {
        "main.launch.yaml": "launch:\n- include: {file: robot.yaml, for_each: {r: [r1, r2]}}\n",
        "robot.yaml": "launch:\n" + node("ekf", namespace="$(var r)", param=_FILE),
        "p.yaml": _section("/ekf"),
    }
    assert told(tmp_path, files) == [(_CODE, "/ekf", "/**/ekf")]


def test_of_sections_with_wildcards_those_names_are_tried_that_stand_below(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    tried = list[str]()

    def counted(pattern: str, name: str) -> bool:
        tried.append(pattern)
        return matches(pattern, name)

    monkeypatch.setattr(sections, "matches", counted)
    file = "".join(
        _section(f"/{pattern}") for number in range(40) for pattern in (f"r{number}/*", f"s{number}/*")
    )
    actions = "".join(node("n", namespace=f"r{number}", param=_FILE) for number in range(40))
    assert told(tmp_path, {"main.launch.yaml": f"launch:\n{actions}", "p.yaml": file}) == []
    assert len(tried) <= 80

"""Components in Python in each of the three containers, over their services."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.supervise.plans import wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.ros.container.conftest import Box, Boxes

# One value of each type that a parameter can have.
_VALUES: dict[str, tuple[str, Any]] = {
    "flag": ("BOOL", True),
    "whole": ("INTEGER", -(2**63)),
    "real": ("DOUBLE", 0.1),
    "text": ("STRING", "ä\n"),
    "bytes": ("BYTE_ARRAY", [0, 255]),
    "flags": ("BOOL_ARRAY", [True, False]),
    "wholes": ("INTEGER_ARRAY", [1, -1]),
    "reals": ("DOUBLE_ARRAY", [1.5, -0.0]),
    "texts": ("STRING_ARRAY", ["", "b"]),
}


@pytest.fixture(autouse=True)
def _nothing_is_left(box: Box, boxes: Boxes) -> Iterator[None]:
    """Unload all after each test, and hold the graph to be as it was."""
    yield
    try:
        box.empty()
    except BaseException:
        boxes.close()  # the next test has another one
        raise


def test_a_component_gets_its_names_remaps_and_parameters(box: Box) -> None:
    name = box.loaded(
        "parts::Plain",  # as its package declares it
        package_name="parts",
        node_name="other",
        node_namespace="/deep/ns",
        remap_rules=["chatter:=/loud"],
        parameters=_VALUES,
        extra_arguments={"use_intra_process_comms": ("BOOL", True), "unheard_of": ("STRING", "x")},
        log_level=10,
    )
    assert name == "/deep/ns/other"
    wait_for(lambda: "/loud PUBLISHER other" in box.asking.graph(box.name), "the remapped topic")
    names = [*_VALUES, "unset"]
    answer = box.asking.call(f"{name}/get_parameters", "rcl_interfaces/srv/GetParameters", names=names)
    assert answer["values"] == [*(value for _, value in _VALUES.values()), "as it is"]


def test_components_have_numbers_of_their_own_that_never_come_again(box: Box) -> None:
    first, second, third = (box.load("Plain", node_name=name)["unique_id"] for name in "abc")
    assert third - second == second - first == 1
    assert box.list() == {first: "/a", second: "/b", third: "/c"}
    assert box.unload(second) == {"success": True, "error_message": ""}
    assert box.list() == {first: "/a", third: "/c"}
    assert box.load("Plain")["unique_id"] == third + 1
    assert box.unload(second) == {
        "success": False,
        "error_message": f"No node found with unique_id: {second}",
    }


def test_a_constructor_that_fails_is_told_and_leaves_nothing(box: Box) -> None:
    answer = box.load("Broken")
    reason = "Component constructor threw an exception: ValueError: no such device"
    assert answer == {"success": False, "error_message": reason, "full_node_name": "", "unique_id": 0}
    assert 'raise ValueError("no such device")' in box.written
    assert box.load("Quitting")["error_message"].endswith("SystemExit: 3")
    assert box.list() == {}
    assert box.loaded("Plain") == "/plain"


@pytest.mark.parametrize(
    ("plugin", "fields", "reason"),
    [
        ("Plane", {}, "module 'components' has no 'Plane'; did you mean 'components:Plain'?"),
        ("TYPES", {}, "'components:TYPES' is no class: it is of type 'dict'"),
        ("no_node", {}, "'no_node' gives no node: it is of type 'int'"),
        ("Demanding", {}, "'Demanding' cannot be made without 'robot', which no container gives"),
        (
            "parts::Plane",
            {},
            "there is no component 'parts::Plane' of package 'demo' in Python here; did you mean 'parts::Plain'?",
        ),
        ("demo::Talker", {}, "there is no component 'demo::Talker' of package 'demo' in Python here"),
        ("nowhere:Talker", {}, "ModuleNotFoundError: No module named 'nowhere'"),
        (
            "Plain",
            {"extra_arguments": {"use_intra_process_comms": ("STRING", "yes")}},
            "Extra component argument 'use_intra_process_comms' must be a boolean",
        ),
    ],
)
def test_what_cannot_be_loaded_is_refused_with_a_reason(
    box: Box, plugin: str, fields: dict[str, Any], reason: str
) -> None:
    answer = box.load(plugin, package_name="demo", **fields)
    assert (answer["success"], answer["error_message"]) == (False, reason)


def test_a_name_that_cannot_be_is_refused(box: Box) -> None:
    answer = box.load("Plain", node_name="no name")
    assert not answer["success"]
    assert "no name" in answer["error_message"]


def test_a_constructor_may_insist_on_a_name_and_have_arguments_of_its_own(box: Box) -> None:
    assert box.loaded("Keywords") == "/keywords"
    assert box.loaded("Keywords", node_name="named", remap_rules=["chatter:=given"]) == "/named"
    assert box.loaded("made_by_a_function", node_name="other") == "/other"
    wait_for(
        lambda: {"/own PUBLISHER keywords", "/given PUBLISHER named"} <= {*box.asking.graph(box.name)},
        "both topics",
    )


def test_nothing_of_a_component_stays(box: Box) -> None:
    """What it had is seen first; that it is gone is seen after each test."""
    assert box.loaded("Everything") == "/everything"
    assert box.loaded("Stubborn") == "/stubborn"
    seen = {
        "node / everything",
        "node / inner",
        "/chatter PUBLISHER stubborn",
        "/chatter PUBLISHER everything",
        "/chatter SUBSCRIPTION everything",
        "service /look/_action/send_goal",
        "service /everything/change_state",
        "service /everything/get_type_description",
    }
    wait_for(lambda: seen <= {*box.asking.graph(box.name)}, "all of it")
    box.empty()
    assert "good-bye" in box.written


def test_what_a_transition_raises_is_in_the_log(box: Box) -> None:
    box.loaded("Unsteady")
    kind = "lifecycle_msgs/srv/ChangeState"
    assert box.asking.call("/everything/change_state", kind, transition={"id": 1}) == {"success": True}
    assert box.asking.call("/everything/change_state", kind, transition={"id": 3}) == {"success": False}
    assert "on_activate has failed:\nTraceback" in box.written
    assert "ValueError: no way from inactive" in box.written


def test_whose_thread_calls_is_as_the_executable_says(box: Box, request: pytest.FixtureRequest) -> None:
    box.loaded("Plain", node_name="first")
    box.loaded("Plain", node_name="second")
    threads = [
        box.asking.call(f"/{name}/thread", "std_srvs/srv/Trigger")["message"] for name in ("first", "second")
    ]
    match request.node.callspec.params["boxes"]:
        case "component_container":
            assert threads == ["MainThread"] * 2
        case "component_container_isolated":
            assert threads == ["first", "second"]
        case _:
            assert all(thread.startswith("ThreadPoolExecutor") for thread in threads)

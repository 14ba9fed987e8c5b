"""Messages, services, parameters and states: what the commands say to nodes and hear from them."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest
import yaml

if TYPE_CHECKING:
    from pathlib import Path

    from tests.ros.tools.conftest import Done, Graph

_ACTOR, _MACHINE = "/robot1/actor", "/robot1/machine"


def test_messages_are_shown_as_yaml(graph: Graph) -> None:
    first, second = (
        graph.told("topic", "echo", "/robot1/chatter", "-n", "2").removesuffix("---\n").split("---\n")
    )
    assert yaml.safe_load(first)["data"].startswith("Hello: ")
    assert first.startswith("data: 'Hello: ")
    assert first != second


def test_who_comes_late_hears_what_a_publisher_keeps(graph: Graph) -> None:
    assert graph.told("topic", "echo", "/robot1/map", "--once") == "data: a map\n---\n"


def test_a_part_of_a_message_is_shown_where_a_condition_holds(graph: Graph) -> None:
    told = graph.told(
        *("topic", "echo", "/robot1/scan", "--once", "--field", "ranges[3]", "--filter", "m == 1.5")
    )
    assert told == "1.5\n---\n"


def test_long_arrays_are_cut_and_whole_in_json(graph: Graph) -> None:
    told = yaml.safe_load(
        graph.told("topic", "echo", "/robot1/scan", "--once", "-l", "2").removesuffix("---\n")
    )
    assert told["ranges"] == [0.0, 0.5, "..."]
    whole = json.loads(graph.told("topic", "echo", "/robot1/scan", "--once", "--format", "json"))
    assert len(whole["ranges"]) == 360


def test_messages_that_do_not_come_in_time_are_an_error(graph: Graph) -> None:
    done = graph.ask(
        "topic", "echo", "/robot1/heard", "--once", "--timeout", "1", "--qos-durability", "volatile"
    )
    assert (done.status, done.output) == (1, "")
    assert done.errors == "error: /robot1/heard: 0 of 1 messages came within 1 s\n"


def test_a_message_that_is_published_once_arrives(graph: Graph) -> None:
    told = graph.told("topic", "pub", "--once", "/robot1/numbers", "std_msgs/msg/Int32", "{data: 7}")
    assert told.endswith("publisher: beginning loop\npublishing #1: std_msgs.msg.Int32(data=7)\n\n")
    assert graph.told("topic", "echo", "/robot1/heard", "--once") == "data: heard 7\n---\n"


def test_a_field_that_a_message_has_not_is_an_error(graph: Graph) -> None:
    done = graph.ask("topic", "pub", "-1", "/robot1/numbers", "std_msgs/msg/Int32", "{dat: 7}")
    assert done.status == 1
    assert done.errors == "error: Failed to populate field: Int32 has no field dat; did you mean data?\n"


def test_the_rate_of_messages_is_measured(graph: Graph) -> None:
    with graph.asking("topic", "hz", "/robot1/scan", "--format", "json") as process:
        assert process.stdout is not None
        for line in process.stdout:
            if (found := json.loads(line))["window"] >= 50:
                break
    assert found["rate"] == pytest.approx(100, rel=0.99)  # as often as a busy machine lets it
    assert found["min"] <= found["max"]


def test_how_much_comes_in_is_measured(graph: Graph) -> None:
    with graph.asking("topic", "bw", "/robot1/scan") as process:
        assert process.stdout is not None
        begin, first, second = (process.stdout.readline() for _ in range(3))
    assert begin == "Subscribed to [/robot1/scan]\n"
    assert "/s from " in first
    assert second.startswith("\tMessage size mean: 1.50 KB min: 1.50 KB")


def _called(graph: Graph, *words: str, given: str = "") -> Done:
    """Call a service that may be called again: DDS loses an answer whose reader its writer has not found yet."""
    for _ in range(3):
        done = graph.ask("service", "call", *words, "--timeout", "20", given=given)
        if done.status == 0:
            break
    return done


def test_a_service_is_called(graph: Graph) -> None:
    done = _called(graph, "/robot1/switch", "std_srvs/srv/SetBool", "{data: true}")
    assert done.output.endswith(
        "requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n"
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='it is so')\n\n"
    ), done.errors
    words = ("/robot1/switch", "std_srvs/srv/SetBool", "--stdin", "--format", "json")
    assert _called(graph, *words, given="data: false").data == {"success": False, "message": "it is so"}


def test_a_service_that_is_not_there_is_waited_for_no_longer_than_said(graph: Graph) -> None:
    done = graph.ask("service", "call", "/robot1/swich", "std_srvs/srv/SetBool", "{}", "--timeout", "1.5")
    assert done.status == 1
    assert done.errors == "error: Unknown service '/robot1/swich'; did you mean /robot1/switch?\n"


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (
            ("service", "call", "/robot1/swich", "std_srvs/srv/SetBool", "{}"),
            "warning: nobody serves /robot1/swich so far; did you mean /robot1/switch?\n",
        ),
        (
            ("topic", "hz", "/robot1/scn", "--format", "json"),
            "WARNING: topic [/robot1/scn] does not appear to be published yet; did you mean /robot1/scan?\n",
        ),
        (
            ("param", "set", "/robot1/actr", "speed", "2.0", "--timeout", "600"),
            "warning: there is no node /robot1/actr so far; did you mean /robot1/actor?\n",
        ),
    ],
)
def test_who_waits_is_told_what_may_be_meant(graph: Graph, words: tuple[str, ...], told: str) -> None:
    with graph.asking(*words) as process:
        assert process.stderr is not None
        assert process.stderr.readline() == told


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("speed", "Double value is: 1.5"),
        ("data", r"Byte values are: [b'\x01', b'\xff']"),
        ("counts", "Integer values are: array('q', [1, 2])"),
    ],
)
def test_parameters_are_shown_with_their_types(graph: Graph, name: str, shown: str) -> None:
    assert graph.told("param", "get", _ACTOR, name) == f"{shown}\n"


def test_a_parameter_takes_the_type_that_is_written(graph: Graph) -> None:
    assert graph.told("param", "set", _ACTOR, "loose", "!!str 1") == "Set parameter successful\n"
    told = graph.ask("param", "get", _ACTOR, "loose", "--format", "json").data
    assert told == {"node": _ACTOR, "name": "loose", "type": "string", "value": "1"}


@pytest.mark.parametrize(
    ("name", "value", "reason"),
    [
        ("count", "4", "The parameter value for count is not a valid step"),
        ("fixed", "y", "Trying to set a read-only parameter"),
        ("speed", "fast", "Wrong parameter type"),
    ],
)
def test_a_parameter_that_cannot_be_set_fails_with_the_reason(
    graph: Graph, name: str, value: str, reason: str
) -> None:
    done = graph.ask("param", "set", _ACTOR, name, value)
    assert (done.status, done.output) == (1, "")
    assert done.errors.startswith(f"error: Setting parameter failed: {reason}")


def test_parameters_are_described(graph: Graph) -> None:
    assert (
        graph.told("param", "describe", _ACTOR, "count", "fixed")
        == """\
Parameter name: count
  Type: integer
  Description: How many
  Constraints:
    Min value: 1
    Max value: 9
    Step: 2
Parameter name: fixed
  Type: string
  Constraints:
    Read only: true
"""
    )


def test_what_is_dumped_can_be_loaded(graph: Graph, tmp_path: Path) -> None:
    """Every type; what is read-only fails, and is told."""
    text = graph.told("param", "dump", _ACTOR)
    assert text.endswith("\n\n")  # as the ROS 2 tools end it
    values = yaml.safe_load(text)[_ACTOR]["ros__parameters"]
    assert values["data"] == [b"\x01", b"\xff"]
    assert values["limits"] == {"max": 2.0}
    assert values["words"] == ["a", "1"]
    file = tmp_path / "actor.yaml"
    file.write_text(text.replace("flag: true", "flag: false"))
    done = graph.ask("param", "load", _ACTOR, str(file))
    assert "Set parameter data successful\n" in done.output
    assert [line.split()[2] for line in done.errors.splitlines()] == [
        "fixed",
        "start_type_description_service",
    ]
    assert done.status == 1
    assert graph.told("param", "get", "--hide-type", _ACTOR, "flag") == "False\n"


def test_a_parameter_is_listed_until_it_is_deleted(graph: Graph) -> None:
    names = graph.told("param", "list", _ACTOR).split()
    assert names == sorted(names)
    assert {"count", "limits.max"} <= set(names)
    done = graph.ask("param", "delete", _ACTOR, "count")
    assert (done.status, done.errors) == (
        1,
        "error: Deleting parameter failed: Static parameter cannot be undeclared\n",
    )


def test_parameters_of_all_nodes_are_listed_by_node(graph: Graph) -> None:
    told = graph.ask("param", "list", "--format", "json", "--filter", "use_sim").data
    assert told == {node: [{"name": "use_sim_time"}] for node in (_ACTOR, _MACHINE)}


def test_a_lifecycle_node_goes_through_its_states(graph: Graph) -> None:
    assert graph.told("lifecycle", "get") == f"{_MACHINE}: unconfigured [1]\n"
    assert graph.told("lifecycle", "list", _MACHINE).startswith(
        "- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n"
    )
    assert graph.told("lifecycle", "set", _MACHINE, "configure") == "Transitioning successful\n"
    failed = graph.ask("lifecycle", "set", _MACHINE, "activate")
    assert failed.status == 1
    assert failed.errors == f"error: Transitioning failed: {_MACHINE} is inactive [2] now\n"
    unknown = graph.ask("lifecycle", "set", _MACHINE, "configure")
    assert unknown.status == 1
    assert "available ones are:\n- cleanup [2]\n- activate [3]\n- shutdown [6]\n" in unknown.errors


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("param", "get", _ACTOR, "cout"), "Parameter not set: /robot1/actor has no parameter cout; did you"),
        (
            ("service", "call", "/robot1/switch", "std_srvs/srv/Trigger"),
            "/robot1/switch is of type std_srvs/srv/SetBool, not std_srvs/srv/Trigger\n",
        ),
    ],
)
def test_what_is_refused_is_told_in_the_words_of_the_ros_2_tools(
    graph: Graph, words: tuple[str, ...], told: str
) -> None:
    done = graph.ask(*words)
    assert done.status == 1
    assert done.errors.startswith(f"error: {told}")

"""What the graph consists of, as the commands show it."""

from __future__ import annotations

import os
import signal
import socket

import pytest

from orchestra.ros.tools.graph.servers import Servers
from tests.ros.tools.conftest import Graph

_ACTOR = "/robot1/actor"


def test_nodes_are_listed_in_order_without_hidden_ones(graph: Graph) -> None:
    assert graph.told("node", "list") == "/robot1/actor\n/robot1/machine\n"


def test_hidden_nodes_are_listed_where_they_are_asked_for(graph: Graph) -> None:
    found = graph.ask("node", "list", "--all", "--format", "json").data
    assert found == ["/robot1/_hidden", "/robot1/actor", "/robot1/machine"]


def test_a_node_tells_what_it_has(graph: Graph) -> None:
    told = graph.told("node", "info", "robot1/actor")
    assert told.startswith(
        """\
/robot1/actor
  Subscribers:
    /robot1/numbers: std_msgs/msg/Int32
  Publishers:
    /parameter_events: rcl_interfaces/msg/ParameterEvent
    /robot1/chatter: std_msgs/msg/String
    /robot1/heard: std_msgs/msg/String
    /robot1/map: std_msgs/msg/String
    /robot1/scan: sensor_msgs/msg/LaserScan
    /rosout: rcl_interfaces/msg/Log
    /tf: tf2_msgs/msg/TFMessage
    /tf_static: tf2_msgs/msg/TFMessage
  Service Servers:
    /robot1/actor/describe_parameters: rcl_interfaces/srv/DescribeParameters
"""
    )
    assert told.endswith(
        """\
    /robot1/switch: std_srvs/srv/SetBool
  Service Clients:
    /robot1/trigger: std_srvs/srv/Trigger
  Action Servers:

  Action Clients:

"""
    )


def test_a_node_that_is_not_there_is_an_error_with_the_near_name(graph: Graph) -> None:
    done = graph.ask("node", "info", "/robot1/actr")
    assert (done.status, done.output) == (1, "")
    assert done.errors == "error: Unable to find node '/robot1/actr'; did you mean /robot1/actor?\n"


def test_topics_are_listed_with_types_and_numbers_of_ends(graph: Graph) -> None:
    told = graph.told("topic", "list", "-v")
    published, subscribed = told.split("\n\n")[:2]
    assert published.startswith(
        "Published topics:\n * /parameter_events [rcl_interfaces/msg/ParameterEvent] 3 publishers"
    )
    assert " * /robot1/chatter [std_msgs/msg/String] 1 publisher\n" in published
    assert "/robot1/_secret" not in told
    assert subscribed.splitlines()[:2] == [
        "Subscribed topics:",
        " * /robot1/numbers [std_msgs/msg/Int32] 1 subscriber",
    ]


def test_an_option_of_the_command_may_stand_before_the_verb(graph: Graph) -> None:
    names = graph.told("topic", "--include-hidden-topics", "list").splitlines()
    assert "/robot1/_secret" in names
    assert names == sorted(names)


def test_topics_of_a_type_are_found(graph: Graph) -> None:
    assert (
        graph.told("topic", "find", "std_msgs/msg/String") == "/robot1/chatter\n/robot1/heard\n/robot1/map\n"
    )
    assert graph.told("topic", "type", "/robot1/scan") == "sensor_msgs/msg/LaserScan\n"


def test_the_ends_of_a_topic_are_told_with_their_policies(graph: Graph) -> None:
    told = graph.told("topic", "info", "-v", "/robot1/map")
    assert told.startswith(
        "Type: std_msgs/msg/String\n\nPublisher count: 1\n\nNode name: actor\nNode namespace: /robot1\n"
    )
    assert "  Durability: TRANSIENT_LOCAL\n  Lifespan: Infinite\n" in told
    assert told.endswith("\n\nSubscription count: 0\n\n")
    (publisher,) = graph.ask("topic", "info", "/robot1/scan", "--format", "json").data["publishers"]
    assert publisher["node"] == _ACTOR
    assert publisher["type_hash"].startswith("RIHS01_")
    assert publisher["qos"]["reliability"] == "best_effort"


def test_services_are_listed_found_and_told_of(graph: Graph) -> None:
    listed = graph.told("service", "list", "-t").splitlines()
    assert "/robot1/switch [std_srvs/srv/SetBool]" in listed
    assert not [line for line in listed if "/_" in line]
    assert graph.told("service", "find", "std_srvs/srv/SetBool") == "/robot1/switch\n"
    assert (
        graph.told("service", "info", "/robot1/switch")
        == "Type: std_srvs/srv/SetBool\nClients count: 0\nServices count: 1\n"
    )


def test_frames_are_drawn(graph: Graph) -> None:
    words = ("tf", "tree", "--wait", "SECONDS")
    lines = graph.in_time(lambda done: len(done.output.splitlines()) == 3, *words).output.splitlines()
    assert lines[0] == "odom"
    assert lines[1].startswith("└─ base  (")
    assert lines[2] == "   └─ laser  (static)"


def test_a_frame_is_told_in_another(graph: Graph) -> None:
    told = graph.ask("tf", "echo", "odom", "laser", "--once", "--format", "json").data
    assert told["translation"] == pytest.approx([1.0, 0.2, 0.0])
    assert told["rpy"] == pytest.approx([0.0, 0.0, 1.5707963])


def test_a_frame_that_nobody_knows_ends_the_wait_in_time(graph: Graph) -> None:
    words = ("tf", "echo", "odom", "lasr", "--timeout", "SECONDS")
    done = graph.in_time(lambda done: "laser" in done.errors.splitlines()[-1], *words)
    assert done.status == 1
    assert done.errors.endswith("there is no frame lasr; did you mean laser?\n")


@pytest.mark.parametrize("words", [("node", "list"), ("topic", "echo", "/a", "std_msgs/msg/String")])
def test_a_domain_that_is_none_is_the_user_s_error(words: tuple[str, ...]) -> None:
    """Of a command that has a bare node, and of one that has a whole one."""
    done = Graph({**os.environ, "ROS_DOMAIN_ID": "abc", "NO_COLOR": "1"}).ask(*words)
    assert done.status == 1
    assert done.errors.startswith("error: the graph cannot be joined: ")
    assert done.errors.endswith("ROS_DOMAIN_ID is not an integral number\n")


def test_a_profile_by_its_name_gives_way_to_what_publishers_offer(graph: Graph) -> None:
    words = ("topic", "echo", "/robot1/scan", "--once", "--field", "angle_min")
    assert graph.told(*words, "--qos-profile", "services_default").endswith("\n---\n")


def test_names_in_the_graph_are_completed(graph: Graph) -> None:
    for words, found in (
        (("topic", "echo", "/robot1/ch"), "/robot1/chatter"),
        (("param", "get", "/robot1/actor", "lim"), "limits.max"),
    ):
        assert graph.told("completion", "--complete", "zsh", *words) == f"{found}\t\n"


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_a_command_ends_quietly_on_a_signal(graph: Graph, number: signal.Signals, status: int) -> None:
    with graph.asking("topic", "echo", "/robot1/scan") as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.readline()
        process.send_signal(number)
        process.stdout.read()
        assert process.wait() == status
        assert process.stderr.read() == ""


def test_a_command_whose_reader_has_gone_ends_quietly(graph: Graph) -> None:
    with graph.asking("topic", "echo", "/robot1/scan") as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.readline()
        process.stdout.close()
        assert process.wait() == 141
        assert process.stderr.read() == ""


def test_a_discovery_server_that_is_not_there_is_told() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as bound:
        bound.bind(("127.0.0.1", 0))
        there = f"127.0.0.1:{bound.getsockname()[1]}"
        assert Servers(there).complaint() is None
        assert Servers(f"127.0.0.1:1;{there}").complaint() is None
    told = Servers(f";{there}; localhost:1").complaint()
    assert told == f"nobody answers at ;{there}; localhost:1, which ROS_DISCOVERY_SERVER names"
    for setting in ("", "TCPv4:[127.0.0.1]:1"):
        assert Servers(setting).complaint() is None


def test_the_graph_of_a_server_that_is_not_there_is_empty_with_a_warning(graph: Graph) -> None:
    done = Graph({**graph.environment, "ROS_DISCOVERY_SERVER": "127.0.0.1:1"}).ask(
        "node", "list", "--spin-time", "0.1"
    )
    assert (done.status, done.output) == (0, "")
    assert "warning: nobody answers at 127.0.0.1:1, which ROS_DISCOVERY_SERVER names\n" in done.errors


def test_who_does_not_answer_is_told_of(graph: Graph) -> None:
    first = 7400 + 250 * int(graph.environment["ROS_DOMAIN_ID"]) + 10 + 2 * 90
    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as deaf,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as beside,
    ):
        deaf.bind(("127.0.0.1", first))
        beside.bind(("127.0.0.1", first + 1))
        done = graph.in_time(
            lambda done: len(done.output.splitlines()) == 2, "node", "list", "--spin-time", "SECONDS"
        )
    assert (done.status, done.output) == (0, "/robot1/actor\n/robot1/machine\n")
    assert done.errors.startswith("warning: not everybody has answered")

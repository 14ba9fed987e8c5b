"""Pictures of a graph."""

from __future__ import annotations

import shutil
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("rclpy", reason="needs ROS")

from orchestra.plan.render import dot, mermaid
from orchestra.ros.tools.graph.system import End, System
from orchestra.ros.tools.picture import data, drawn, text

if TYPE_CHECKING:
    from pathlib import Path

    from tests.ros.tools.conftest import Graph


def _end(topic: str, node: str, reliability: str = "reliable") -> End:
    profile: dict[str, Any] = {
        "reliability": reliability,
        "durability": "volatile",
        "liveliness": "automatic",
        "deadline": None,
        "liveliness_lease_duration": None,
    }
    return End(topic, node, "a/msg/A", "", f"{topic} {node}", profile)


_SEEN = System(
    ("/map", "/robot1/control", "/robot1/lidar"),
    (_end("/robot1/scan", "/robot1/lidar", "best_effort"), _end("/robot1/cmd", "/robot1/control")),
    (_end("/robot1/scan", "/robot1/control", "best_effort"), _end("/robot1/scan", "/map")),
    [],
)


def test_each_node_tells_with_whom_it_talks() -> None:
    assert text(_SEEN) == (
        "/map\n  hears /robot1/scan [a/msg/A] from /robot1/lidar\n\n"
        "/robot1/control\n  publishes /robot1/cmd [a/msg/A] to nobody\n"
        "  hears /robot1/scan [a/msg/A] from /robot1/lidar\n\n"
        "/robot1/lidar\n  publishes /robot1/scan [a/msg/A] to /map, /robot1/control\n"
    )


def test_a_subscription_that_gets_nothing_is_dashed() -> None:
    assert mermaid.text(drawn(_SEEN)) == (
        "flowchart LR\n"
        '  n1("/map")\n'
        '  subgraph g_2f_robot1 ["/robot1"]\n'
        '    n2("/robot1/control")\n'
        '    n3("/robot1/lidar")\n'
        '    t1["/robot1/cmd<br/>a/msg/A"]\n'
        '    t2["/robot1/scan<br/>a/msg/A"]\n'
        "  end\n"
        "  n3 --> t2\n"
        "  n2 --> t1\n"
        "  t2 --> n2\n"
        "  t2 -.-> n1\n"
    )
    assert '  t2 -> n1 [label="", style=dashed];' in dot.text(drawn(_SEEN), "ros")
    scan = next(topic for topic in data(_SEEN)["topics"] if topic["name"] == "/robot1/scan")
    assert scan["subscriptions"] == [
        {"node": "/robot1/control", "fed": True},
        {"node": "/map", "fed": False},
    ]


def test_the_running_graph_is_drawn(graph: Graph) -> None:
    told = graph.told("graph", "--node", "/robot1/machine")
    assert told == (
        "/robot1/machine\n"
        "  publishes /robot1/machine/transition_event [lifecycle_msgs/msg/TransitionEvent] to nobody\n"
    )
    found = graph.ask("graph", "--all", "--format", "json").data
    assert "/robot1/_hidden" in found["nodes"]
    assert "/rosout" in [topic["name"] for topic in found["topics"]]
    assert "/rosout" not in graph.told("graph", "--format", "mermaid")


@pytest.mark.skipif(shutil.which("dot") is None, reason="needs Graphviz")
def test_pictures_are_drawn_by_graphviz(graph: Graph, tmp_path: Path) -> None:
    file = tmp_path / "frames.pdf"
    told = graph.told("tf", "tree", "--pdf", str(file), "--wait", "0.5", "--spin-time", "60")
    assert told == f"{file}\n"
    assert file.read_bytes().startswith(b"%PDF-")
    for words in (
        ("graph", "--format", "svg"),
        ("tf", "tree", "--svg", "--wait", "0.5", "--spin-time", "60"),
    ):
        image = graph.told(*words)
        assert image.startswith("<?xml")
        assert "<title>" in image

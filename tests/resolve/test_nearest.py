from __future__ import annotations

import pytest

from orchestra.nearest import nearest


@pytest.mark.parametrize(
    ("word", "candidates", "meant"),
    [
        ("demo_node_cpp", ["demo_nodes_cpp", "demo_nodes_py"], "demo_nodes_cpp"),
        ("exec_", ["exec", "name", "param"], "exec"),
        ("nmae", ["namespace", "name"], "name"),
        ("robot-state-publisher", ["robot_state_publisher"], "robot_state_publisher"),
        ("RobotState", ["robot_state"], "robot_state"),
        ("ns", ["namespace", "name"], None),
        ("zzz", ["abc", "def"], None),
        ("a", ["b"], None),
        ("", ["a"], None),
        ("a", [], None),
        ("name", ["name", "names"], "names"),
        ("lis", ["list", "lisp"], "lisp"),
    ],
)
def test_the_nearest_word_is_meant(word: str, candidates: list[str], meant: str | None) -> None:
    assert nearest(word, candidates) == meant

"""What `doctor` says of a graph in which much is wrong, and of one in which nothing is."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.cli.ros.doctor import CHECKS as NAMES
from orchestra.testing.domain import free_domain
from tests.killing import kill
from tests.ros.tools.conftest import Graph

if TYPE_CHECKING:
    from collections.abc import Iterator

_PROGRAM = Path(__file__).parents[3] / "processes" / "ailing.py"


@pytest.fixture(scope="module")
def ill() -> Iterator[Graph]:
    """The nodes of `tests/processes/ailing.py`."""
    pytest.importorskip("rclpy", reason="needs ROS")
    with free_domain({}) as number:
        here = {
            **os.environ,
            "ROS_DOMAIN_ID": str(number),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "NO_COLOR": "1",
        }
        with subprocess.Popen(
            [sys.executable, str(_PROGRAM)],
            env=here,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        ) as process:
            try:
                assert process.stdout is not None
                assert process.stdout.readline() == "ready\n"
                yield Graph(here)
            finally:
                kill(process)


@pytest.fixture(scope="module")
def findings(ill: Graph) -> dict[str, list[dict[str, Any]]]:
    """What is found, by check."""
    while True:  # a machine that is busy hears less; the time limit of the test ends it
        done = ill.ask("doctor", "--format", "json", "--listen", "4", "--timeout", "3")
        assert done.status == 1, done.errors
        found: dict[str, list[dict[str, Any]]] = {name: [] for name in NAMES}
        for finding in json.loads(done.output)["findings"]:
            found[finding["check"]].append(finding)
        frames = {name for finding in found["frames"] for name in finding["about"]}
        if len(found["answers"]) == 1 and {"slow", "arm", "island"} <= frames and found["clock"]:
            return found


def test_all_checks_have_a_name_that_can_be_asked_for() -> None:
    pytest.importorskip("rclpy", reason="needs ROS")
    from orchestra.ros.tools.doctor.checks.table import CHECKS  # noqa: PLC0415 - it needs ROS

    assert list(CHECKS) == list(NAMES)


def test_pairs_that_do_not_fit_are_told_with_policy_and_values(
    findings: dict[str, list[dict[str, Any]]],
) -> None:
    assert [finding["message"] for finding in findings["qos"]] == [
        "/ill/map: nothing that /ill/driver publishes reaches /ill/mapper: "
        "durability is volatile, asked for is transient_local",
        "/ill/scan: nothing that /ill/driver publishes reaches /ill/mapper: "
        "reliability is best_effort, asked for is reliable",
    ]
    assert findings["qos"][0]["details"]["policies"] == [
        {"policy": "durability", "offered": "volatile", "requested": "transient_local"}
    ]


def test_topics_with_two_types_are_told(findings: dict[str, list[dict[str, Any]]]) -> None:
    assert [finding["message"] for finding in findings["types"]] == [
        "/ill/mixed has 2 types: std_msgs/msg/Int32 (/ill/driver); std_msgs/msg/String (/ill/other)"
    ]


def test_slips_are_told_and_other_ends_that_nobody_has_are_not(
    findings: dict[str, list[dict[str, Any]]],
) -> None:
    assert [finding["about"] for finding in findings["unmatched"]] == [["/ill/velocty", "/ill/velocity"]]


def test_nodes_with_one_name_and_nodes_that_hang_are_told(findings: dict[str, list[dict[str, Any]]]) -> None:
    assert [finding["about"] for finding in findings["names"]] == [["/ill/twin"]]
    assert [finding["about"] for finding in findings["answers"]] == [["/ill/hung"]]


def test_nodes_with_another_time_are_told(findings: dict[str, list[dict[str, Any]]]) -> None:
    """Not the one that publishes the clock."""
    (found,) = findings["time"]
    assert found["details"]["use_sim_time"] == ["/ill/planner"]
    assert found["details"]["real_time"] == ["/ill/driver", "/ill/mapper", "/ill/twin"]


def test_a_clock_that_is_set_back_is_told_once(findings: dict[str, list[dict[str, Any]]]) -> None:
    (found,) = (finding for finding in findings["clock"] if finding["about"])
    assert found["message"].startswith("/clock jumps back by 0.")


def test_faults_of_frames_are_told(findings: dict[str, list[dict[str, Any]]]) -> None:
    messages = [finding["message"] for finding in findings["frames"]]
    assert messages[0] == "the frame wheel has 2 parents: base, odom"
    assert "nothing connects the frames below island with those below odom" in messages
    about = [tuple(finding["about"]) for finding in findings["frames"]]
    assert ("base", "arm") in about
    assert ("base", "slow") in about
    assert not [one for one in about if "laser" in one]


def test_checks_can_be_chosen(ill: Graph) -> None:
    done = ill.ask("doctor", "--only", "names")
    lines = done.output.splitlines()
    assert (done.status, lines[0]) == (1, "names: 2 nodes have the name /ill/twin")
    assert lines[1].startswith("1 thing is wrong: ")
    assert len(lines) == 2


def test_what_is_well_is_well(graph: Graph) -> None:
    done = graph.ask("doctor", "--report", "--skip", "frames", "--timeout", "60")
    assert done.status == 0, done.output
    assert done.output.splitlines()[-1].startswith("nothing is wrong: 2 nodes in domain ")
    assert "\nmiddleware\n  implementation: rmw_fastrtps_cpp\n" in done.output
    assert "    publishers: /robot1/actor (best_effort, volatile)\n" in done.output


def test_nodes_of_a_run_that_cannot_meet_are_told(tmp_path: Path, ill: Graph) -> None:
    (tmp_path / "idle.py").write_text("import signal\nprint('up', flush=True)\nsignal.pause()\n")
    nodes = "".join(
        f"  - node: {{script: $(dirname)/idle.py, name: {name}, env: [{{name: ROS_DOMAIN_ID, value: '{domain}'}}]}}\n"
        for name, domain in (("here", 3), ("there", 4), ("everywhere", 3))
    )
    (tmp_path / "run.yaml").write_text(f"launch:\n{nodes}")
    here = Graph({**ill.environment, "ORCHESTRA_HOME": str(tmp_path / "home")})
    with here.asking("launch", str(tmp_path / "run.yaml")) as run:
        assert run.stdout is not None
        up = 0
        while up < 3:
            line = run.stdout.readline()
            assert line
            up += line.rstrip().endswith("up")
        done = here.ask("doctor", "--only", "settings")
        run.terminate()
        run.stdout.read()
        run.wait()
    assert done.status == 1
    assert done.output.startswith(
        "settings: in the run run, ROS_DOMAIN_ID is 3 for /everywhere, /here, 4 for /there\n"
    )

"""Nodes that cannot use their command line end with one line and status 1."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

DOMAIN = 89


@pytest.mark.parametrize(
    ("node", "line", "said"),
    [
        ("simulation", "speed: [1, 2.5]", "Sequence should be of same type"),
        ("velocity_controller", "seed: []", "'seed' is not initialized"),
        ("fleet_monitor", "rate: [1, 2.5]", "Sequence should be of same type"),
    ],
)
def test_a_parameter_file_that_is_refused_ends_a_node_with_one_line(
    node: str, line: str, said: str, tmp_path: Path
) -> None:
    file = tmp_path / "given.yaml"
    file.write_text(f"/**/{node}:\n  ros__parameters:\n    {line}\n")
    done = run(node, "--params-file", str(file))
    assert done.returncode == 1
    assert sum(said in each for each in done.stderr.splitlines()) == 1
    assert node in done.stderr.splitlines()[-1]
    assert "Traceback" not in done.stderr


def test_arguments_that_ros_does_not_know_are_named() -> None:
    done = run("fleet_monitor", "--paramsfile", "given.yaml")
    assert (done.returncode, done.stderr.splitlines()[-1]) == (
        1,
        "fleet_monitor: unknown arguments after --ros-args: ['--paramsfile', 'given.yaml']",
    )


def run(node: str, *arguments: str) -> "subprocess.CompletedProcess[str]":
    command = [sys.executable, "-m", f"bringup.nodes.{node}", "--ros-args", *arguments]
    environment = {**os.environ, "ROS_DOMAIN_ID": str(DOMAIN), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60.0, check=False)

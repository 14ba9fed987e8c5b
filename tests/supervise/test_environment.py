from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.environment import Host, middleware, node_environment
from orchestra.supervise.host import this_host

if TYPE_CHECKING:
    from pathlib import Path

BARE = Host("/env", None, (), ament=False)
WHEELS = Host("/env", "/env/bin", ("/env/lib", "/env/site/ros_a.libs"), ament=True)


def environment(
    caller: dict[str, str],
    description: dict[str, str | None] | None = None,
    host: Host = BARE,
    colour: bool = False,
    inherit: bool = True,
) -> dict[str, str]:
    return node_environment(
        caller,
        host,
        description or {},
        log_folder="/run/logs/ros",
        colour=colour,
        marks=("1f-7", "/robot1/ekf"),
        inherit=inherit,
    )


@pytest.mark.conforms("4.10 other variables")
def test_a_plain_interpreter_adds_only_what_the_run_needs() -> None:
    assert environment({"A": "1"}) == {
        "A": "1",
        "PYTHONUNBUFFERED": "1",
        "PYTHONFAULTHANDLER": "1",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_LOG_DIR": "/run/logs/ros",
        "ORCHESTRA_RUN": "1f-7",
        "ORCHESTRA_PROCESS": "/robot1/ekf",
    }


@pytest.mark.parametrize(
    "caller",
    [
        {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET"},
        {"ROS_LOCALHOST_ONLY": "0"},
        {"ROS_DISCOVERY_SERVER": "10.0.0.1:11811"},
    ],
)
def test_whoever_says_how_far_discovery_reaches_is_believed(caller: dict[str, str]) -> None:
    assert middleware(environment({**caller, "ROS_HOME": "/h"})) == {**caller, "ROS_HOME": "/h"}


@pytest.mark.conforms("4.10 ROS_LOG_DIR")
@pytest.mark.parametrize("caller", [{"ROS_LOG_DIR": "/mine"}, {"ROS_HOME": "/mine"}])
def test_the_callers_place_for_logs_stays(caller: dict[str, str]) -> None:
    assert environment(caller).get("ROS_LOG_DIR") == caller.get("ROS_LOG_DIR")


def test_the_description_wins_over_everything_but_the_marks() -> None:
    result = environment(
        {"A": "1", "B": "2"},
        {
            "A": None,
            "B": "3",
            "PYTHONUNBUFFERED": None,
            "ORCHESTRA_RUN": "x",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "OFF",
        },
    )
    assert "A" not in result
    assert "PYTHONUNBUFFERED" not in result
    assert (result["B"], result["ORCHESTRA_RUN"], result["ROS_AUTOMATIC_DISCOVERY_RANGE"]) == (
        "3",
        "1f-7",
        "OFF",
    )


def test_the_wheels_are_found_and_bootstrapped() -> None:
    caller = {"LD_LIBRARY_PATH": "/opt/lib:/env/lib", "AMENT_PREFIX_PATH": "/ws", "PATH": "/usr/bin"}
    result = environment(caller, host=WHEELS)
    assert result["LD_LIBRARY_PATH"] == "/env/lib:/env/site/ros_a.libs:/opt/lib"
    assert result["AMENT_PREFIX_PATH"] == "/ws:/env"
    assert result["PATH"] == "/env/bin:/usr/bin"
    assert result["_ROS_WHEELS_BOOTSTRAP_COMPLETE"] == "1"


def test_an_activated_environment_keeps_its_order() -> None:
    assert environment({"PATH": "/usr/bin:/env/bin"}, host=WHEELS)["PATH"] == "/usr/bin:/env/bin"


def test_twice_is_as_once() -> None:
    """A node may itself be an Orchestra."""
    once = environment({"PATH": "/usr/bin"}, host=WHEELS)
    assert environment(once, host=WHEELS) == once


@pytest.mark.parametrize(("colour", "expected"), [(True, "1"), (False, None)])
def test_nodes_colour_their_logs_where_it_is_seen(colour: bool, expected: str | None) -> None:
    assert environment({}, colour=colour).get("RCUTILS_COLORIZED_OUTPUT") == expected
    assert environment({"RCUTILS_COLORIZED_OUTPUT": "0"}, colour=colour)["RCUTILS_COLORIZED_OUTPUT"] == "0"


def test_no_interpreter_of_a_node_starts_twice_and_rclpy_is_there() -> None:
    """The wheels' bootstrapper replaces the process where its variable is missing; ours makes that needless."""
    clean = {
        name: value
        for name, value in os.environ.items()
        if name not in ("LD_LIBRARY_PATH", "AMENT_PREFIX_PATH")
    }
    clean.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None)
    host = this_host()
    result = environment(clean, host=host)
    code = (
        "import sys, os, rclpy, ament_index_python as index\n"
        "assert index.get_package_prefix('rclpy')\n"
        "print(os.environ['LD_LIBRARY_PATH'])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], env=result, capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout.strip() == result["LD_LIBRARY_PATH"]


def test_a_library_path_of_the_description_does_not_keep_rclpy_from_nodes() -> None:
    """The plan knows nothing of the wheels' folders: the interpreter of the node adds them to what it says."""
    result = environment(dict(os.environ), {"LD_LIBRARY_PATH": "/of/the/description"}, host=this_host())
    code = "import os, rclpy\nprint('/of/the/description' in os.environ['LD_LIBRARY_PATH'].split(':'))"
    done = subprocess.run(
        [sys.executable, "-c", code], env=result, capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout.strip() == "True"


def test_a_process_that_inherits_nothing_gets_what_a_ros_process_cannot_start_without() -> None:
    caller = {"HOME": "/home/me", "PATH": "/usr/bin", "ROS_DOMAIN_ID": "7", "LD_LIBRARY_PATH": "/opt/lib"}
    assert environment(caller, {"A": "1", "B": None}, inherit=False) == {
        "A": "1",
        "ROS_LOG_DIR": "/run/logs/ros",
        "ORCHESTRA_RUN": "1f-7",
        "ORCHESTRA_PROCESS": "/robot1/ekf",
    }
    assert environment(caller, {"ROS_LOG_DIR": "/mine"}, host=WHEELS, inherit=False) == {
        "LD_LIBRARY_PATH": "/env/lib:/env/site/ros_a.libs",
        "AMENT_PREFIX_PATH": "/env",
        "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1",
        "ROS_LOG_DIR": "/mine",
        "ORCHESTRA_RUN": "1f-7",
        "ORCHESTRA_PROCESS": "/robot1/ekf",
    }


def test_a_node_that_inherits_nothing_can_be_made(tmp_path: Path) -> None:
    result = environment(dict(os.environ), {"ROS_LOG_DIR": str(tmp_path)}, host=this_host(), inherit=False)
    code = "import rclpy; rclpy.init(args=[], domain_id=37); rclpy.create_node('a').destroy_node(); rclpy.shutdown()"
    subprocess.run([sys.executable, "-c", code], env=result, timeout=60, check=True)

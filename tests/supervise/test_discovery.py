from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING
from xml.etree import ElementTree as ET

import pytest

from orchestra.supervise.graph.discovery import quick_discovery

if TYPE_CHECKING:
    from pathlib import Path

_NODE = """
import rclpy
rclpy.init()
rclpy.create_node("quick").destroy_node()
rclpy.shutdown()
"""


def test_the_profile_is_written_and_named_by_both_settings(tmp_path: Path) -> None:
    settings = quick_discovery({}, tmp_path)
    assert set(settings) == {"FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE"}
    (path,) = set(settings.values())
    assert ET.parse(path).getroot().tag.endswith("profiles")  # noqa: S314 - our own file


@pytest.mark.parametrize(
    "caller",
    [
        {"FASTRTPS_DEFAULT_PROFILES_FILE": "mine.xml"},
        {"FASTDDS_DEFAULT_PROFILES_FILE": "mine.xml"},
        {"ROS_DISCOVERY_SERVER": "127.0.0.1:11811"},
        {"RMW_IMPLEMENTATION": "rmw_cyclonedds_cpp"},
    ],
)
def test_who_configures_discovery_keeps_it(caller: dict[str, str], tmp_path: Path) -> None:
    assert quick_discovery(caller, tmp_path) == {}
    assert list(tmp_path.iterdir()) == []


def test_the_middleware_reads_the_profile_without_a_word(tmp_path: Path) -> None:
    """An entry that it does not know would be told on standard error."""
    pytest.importorskip("rclpy", reason="needs ROS")
    environment = {
        **os.environ,
        "ROS_DOMAIN_ID": "61",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        **quick_discovery({}, tmp_path),
    }
    done = subprocess.run(
        [sys.executable, "-c", _NODE], env=environment, capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stderr == ""

"""What a node needs is there before it is forked: it loads nothing more until its first message."""

from __future__ import annotations

import subprocess
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

_NODE = """
import rclpy
from geometry_msgs.msg import Twist
from std_srvs.srv import Trigger

def begin():
    rclpy.init(domain_id=206)
    node = rclpy.create_node("a")
    node.create_publisher(Twist, "a", 1).publish(Twist())
    node.create_service(Trigger, "b", print)
    node.create_client(Trigger, "b")
    rclpy.try_shutdown()
"""
_COUNTED = """
import runpy, sys
from pathlib import Path
from orchestra.ros.warm.preloading import preload, preload_common

def loaded():
    lines = Path("/proc/self/maps").read_text().splitlines()
    return {line.split()[-1] for line in lines if "rosidl" in line and ".so" in line}

preload_common()
preload([("script", sys.argv[1])])
libraries, modules = loaded(), set(sys.modules)
runpy.run_path(sys.argv[1])["begin"]()
print(sorted(loaded() - libraries), sorted(set(sys.modules) - modules))
"""


def test_a_node_loads_nothing_until_its_first_message(tmp_path: Path) -> None:
    node = tmp_path / "node.py"
    node.write_text(_NODE)
    command = [sys.executable, "-c", _COUNTED, str(node)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert done.stdout.strip() == "[] []"

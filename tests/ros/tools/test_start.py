"""What a command has done by the time it answers: little, since all of them begin so."""

from __future__ import annotations

import socket
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.wheels import DONE, LIBRARY_PATH, as_called, library_folders

if TYPE_CHECKING:
    from tests.ros.tools.conftest import Graph

# Its extension, which loads the middleware, and what is around it: looking at the graph needs none of it.
_HEAVY = (
    "rclpy._rclpy_pybind11",
    "rclpy.context",
    "rclpy.executors",
    "rclpy.node",
    "rclpy.parameter",
    "rclpy.qos",
)
_IMPORTED = """
import sys
from importlib import import_module
from orchestra.ros.tools.postponing import postpone
postpone()
import_module("orchestra.ros.tools." + sys.argv[1])
import_module("orchestra.ros.tools.graph.wire.node")
print(*(name for name in sys.argv[2:] if name in sys.modules), len(sys.modules))
"""
_AUDITED = """
import os
import sys
from orchestra.__main__ import main
started = ("os.exec", "os.fork", "os.posix_spawn", "subprocess.Popen")
sys.addaudithook(lambda event, _: event in started and os.write(2, event.encode()))
sys.argv[0] = "orchestra"
main()
"""


@pytest.mark.parametrize(
    "tool", ["nodes", "topics", "services", "parameters", "parameter_files", "lifecycle"]
)
def test_looking_and_asking_import_nothing_of_rclpy(tool: str) -> None:
    pytest.importorskip("rclpy", reason="needs ROS")
    told = subprocess.run(
        [sys.executable, "-c", _IMPORTED, tool, *_HEAVY], capture_output=True, text=True, check=True
    )
    *heavy, count = told.stdout.split()
    assert heavy == []
    assert int(count) < 200


def _asked(environment: dict[str, str], *words: str) -> tuple[str, str]:
    done = subprocess.run(
        [sys.executable, "-c", _AUDITED, *words],
        env=environment,
        capture_output=True,
        text=True,
        check=True,
        timeout=100,
    )
    return done.stdout, done.stderr


def test_a_process_that_has_the_libraries_answers_itself(graph: Graph) -> None:
    called = dict(as_called(graph.environment))
    assert _asked(called, "node", "list") == ("/robot1/actor\n/robot1/machine\n", "")


def test_another_is_started_again_with_them(graph: Graph) -> None:
    if not library_folders(Path(sys.prefix)):
        pytest.skip("the libraries of ROS are in no folders of their own")
    bare = {**as_called(graph.environment), DONE: "1", LIBRARY_PATH: ""}
    assert _asked(bare, "node", "list") == ("/robot1/actor\n/robot1/machine\n", "os.exec")


def test_what_is_no_name_of_a_service_is_a_mistake(graph: Graph) -> None:
    for words in (("info", "/no name"), ("call", "/no name", "std_srvs/srv/Empty")):
        done = graph.ask("service", *words)
        assert done.status == 1
        assert done.errors.startswith("error: ")
        assert "must not contain characters other than alphanumerics" in done.errors


def test_sockets_have_room_for_the_answers_of_all() -> None:
    pytest.importorskip("rclpy", reason="needs ROS")
    from orchestra.ros.tools.graph.ports import ROOM, widen  # noqa: PLC0415 - with rclpy only

    with (
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as one,
        socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as as_wide,
        socket.socket(socket.AF_INET, socket.SOCK_STREAM) as stream,
    ):
        as_wide.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, ROOM)
        before = stream.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF)
        widen()
        assert one.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) == as_wide.getsockopt(
            socket.SOL_SOCKET, socket.SO_RCVBUF
        )
        assert stream.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) == before


_NOISY = """
import os, sys
from types import SimpleNamespace
from orchestra.ros.tools.answering import answer

def tell(_):
    os.write(1, b"noise\\n")
    sys.stdout.write("answer\\n")
    return 0

sys.modules["orchestra.ros.tools.noisy"] = SimpleNamespace(tell=tell)
answer({"command": "noisy", "tool": "noisy:tell", "options": {}})
"""


def test_what_the_middleware_writes_on_standard_output_is_no_part_of_the_answer() -> None:
    told = subprocess.run([sys.executable, "-c", _NOISY], capture_output=True, text=True, check=True)
    assert (told.stdout, told.stderr) == ("answer\n", "noise\n")

"""`service echo`, of a server that tells what it is asked and answers."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.testing.domain import free_domain
from tests.killing import kill
from tests.ros.tools.conftest import Graph

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_SERVER = """
import rclpy
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from std_srvs.srv import SetBool
rclpy.init()
node = rclpy.create_node("server")
def answer(request, response):
    response.message = "it is so"
    return response
service = node.create_service(SetBool, "switch", answer)
service.configure_introspection(node.get_clock(), qos_profile_system_default, ServiceIntrospectionState.CONTENTS)
print("ready", flush=True)
rclpy.spin(node)
"""


@pytest.fixture
def shell() -> Iterator[Graph]:
    """A domain with the server in it."""
    pytest.importorskip("rclpy", reason="needs ROS")
    with free_domain({}) as number:
        here = {
            **os.environ,
            "ROS_DOMAIN_ID": str(number),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "NO_COLOR": "1",
        }
        with subprocess.Popen(
            [sys.executable, "-c", _SERVER], env=here, stdout=subprocess.PIPE, text=True
        ) as server:
            try:
                assert server.stdout is not None
                assert "ready\n" in server.stdout  # the middleware may say something before
                yield Graph(here)
            finally:
                kill(server)


def test_requests_and_responses_are_shown(shell: Graph) -> None:
    with (
        shell.asking("service", "echo", "/switch", "-n", "2") as echo,
        shell.asking("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: true}", "-r", "2"),
    ):
        assert echo.stdout is not None
        told = echo.stdout.read()
        assert echo.wait() == 0
    assert told.count("\n---\n") == 2
    assert "  event_type: REQUEST_RECEIVED\n" in told or "  event_type: RESPONSE_SENT\n" in told
    assert "- data: true\n" in told or "message: it is so\n" in told


def test_a_service_that_nobody_has_is_told(shell: Graph) -> None:
    done = shell.ask("service", "echo", "/swich")
    assert (done.status, done.errors) == (1, "error: Unknown service '/swich'; did you mean /switch?\n")


def test_what_a_service_is_asked_and_answers_is_recorded(shell: Graph, tmp_path: Path) -> None:
    pytest.importorskip("mcap", reason="needs the extra `ros`")
    for calls in (
        2,
        5,
        20,
    ):  # the first may come before the server knows the recorder, the last after its end
        folder = tmp_path / f"{calls}"
        with shell.asking("bag", "record", "--services", "switch", "-o", str(folder)) as recorder:
            assert recorder.stdout is not None
            assert "+ /switch/_service_event [std_srvs/srv/SetBool_Event]\n" in recorder.stdout
            for _ in range(calls):
                shell.told("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: true}")
            recorder.send_signal(signal.SIGINT)
            assert recorder.wait() == 0
        told = shell.told("bag", "info", "-v", str(folder))
        counts = r"Request Count: [1-9]\d* \| Response Count: [1-9]\d* "
        if found := re.search(rf"Service: /switch \| Type: std_srvs/srv/SetBool \| {counts}", told):
            break
    assert found, told
    highlevel = pytest.importorskip("rosbags.highlevel")
    with highlevel.AnyReader([folder]) as reader:  # which opens no bag whose hashes it cannot follow
        assert len(list(reader.messages())) >= 2

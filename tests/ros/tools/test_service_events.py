"""`service echo`, of a server that tells what it is asked and answers."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.testing.domain import free_domain
from tests.killing import kill
from tests.ros.tools.conftest import Graph

if TYPE_CHECKING:
    from collections.abc import Iterator

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

"""Commands of the ROS 2 tools about what is between machines: datagrams to many, and the daemon that there is not."""

from __future__ import annotations

import json
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from tests.cli.conftest import Command


def test_a_datagram_to_many_is_received() -> None:
    program = [sys.executable, "-m", "orchestra", "multicast"]
    with subprocess.Popen(
        [*program, "receive", "--timeout", "60"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as receiver:
        try:
            assert receiver.stdout is not None
            if receiver.stdout.readline() != "Waiting for UDP multicast datagram...\n":
                pytest.skip("this machine has no network for it")
            sent = subprocess.run([*program, "send"], capture_output=True, text=True, check=False)
            if sent.returncode:
                pytest.skip(sent.stderr)
            assert receiver.stdout.readline().endswith(": 'Hello World!'\n")
            assert receiver.wait() == 0
        finally:
            receiver.kill()


def test_a_datagram_that_does_not_come_is_told(orchestra_here: Command) -> None:
    done = orchestra_here("multicast", "receive", "--timeout", "0", "--format", "json")
    assert done.returncode == 1
    assert done.stdout == ""


@pytest.mark.parametrize("verb", ["start", "status", "stop"])
def test_there_is_no_daemon(orchestra_here: Command, verb: str) -> None:
    assert orchestra_here("daemon", verb).stdout.startswith(
        ("There is no daemon", "The daemon is not running")
    )
    assert json.loads(orchestra_here("daemon", verb, "--format", "json").stdout) == {"running": False}

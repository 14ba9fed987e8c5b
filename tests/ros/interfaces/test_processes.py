"""Processes that exchange TFMessage over DDS, and come to a clean end."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.killing import kill

_FOLDER = Path(__file__).parent
_HASH = "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"


@pytest.fixture
def environment() -> dict[str, str]:
    return {**os.environ, "ROS_DOMAIN_ID": "53", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


def _start(program: str, environment: dict[str, str]) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-X", "dev", "-W", "ignore", str(_FOLDER / program)],
        env=environment,
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def _end(process: subprocess.Popen[str]) -> str:
    try:
        output, errors = process.communicate(timeout=90)
    finally:
        kill(process)
    assert (process.returncode, errors) == (0, "")
    return output


def test_a_late_listener_hears_the_static_transforms(environment: dict[str, str]) -> None:
    with _start("talker.py", environment) as talker:
        assert talker.stdout is not None
        assert talker.stdout.readline() == "published\n"
        with _start("listener.py", environment) as listener:
            heard = json.loads(_end(listener))
        _end(talker)
    assert heard["type"] == "tf2_msgs/msg/TFMessage"
    assert heard["hash"] == _HASH
    assert heard["message"].startswith(
        "tf2_msgs.msg.TFMessage(transforms=[geometry_msgs.msg.TransformStamped("
    )
    assert heard["message"].count("child_frame_id='robot1/laser'") == 3
    assert heard["message"].count("frame_id='robot1/base_link'") == 3
    assert heard["message"].count("x=0.25") == 3


def test_threads_that_publish_and_take_do_not_lock_each_other_out(environment: dict[str, str]) -> None:
    """Callbacks in bytecode stop this for ever: one thread waits for the interpreter, one for the middleware."""
    with _start("crowd.py", environment) as crowd:
        assert _end(crowd) == "done\n"


@pytest.mark.parametrize(
    "program",
    [
        "from orchestra.ros.interfaces import tf_message_type as t; type(t()).__import_type_support__()",
        "import gc, weakref\n"
        "from orchestra.ros.interfaces import tf_message_type as t\n"
        "from rclpy.serialization import serialize_message\n"
        "import sys; serialize_message(t()())\n"
        "del sys.modules['orchestra.ros.interfaces.tf2'], t; gc.collect()\n"
        "from orchestra.ros.interfaces import tf_message_type as t\n"
        "serialize_message(t()()); gc.collect()",
    ],
    ids=["unused", "made twice"],
)
def test_the_interpreter_ends_cleanly(program: str) -> None:
    done = subprocess.run(
        [sys.executable, "-X", "dev", "-W", "ignore", "-c", program],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert (done.returncode, done.stderr, done.stdout) == (0, "", "")

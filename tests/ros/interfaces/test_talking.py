"""Two processes that talk in types that neither has installed: a topic, a service and an action."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from tests.killing import kill
from tests.ros.interfaces import own

_FOLDER = Path(__file__).parent


def _start(program: str, folder: Path | None, path: str) -> subprocess.Popen[str]:
    environment = {"ROS_DOMAIN_ID": "170", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONPATH": path}
    return subprocess.Popen(
        [sys.executable, "-W", "ignore", str(_FOLDER / program), str(folder or "")],
        env={**os.environ, **environment},
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


def conversation(
    server: Path | None, client: Path | None, *, server_path: str = "", client_path: str = ""
) -> Any:
    """Return what the client tells; each has the definitions in a folder, or finds the package on its path."""
    with _start("server.py", server, server_path) as serving:
        assert serving.stdout is not None
        assert serving.stdout.readline() == "ready\n", serving.communicate()
        with _start("client.py", client, client_path) as asking:
            told = json.loads(_end(asking))
        _end(serving)
    return told


def right(told: Any) -> None:
    """Look at what the client told."""
    assert told["answer"] == [True, True]
    assert told["result"] == [4, "own_interfaces.action.Go_Result(notes=['there', 'é'], distance=2.5)"]
    assert told["feedback"] == [1.5]
    assert told["heard"].count("wide='a😀'") == 2
    assert "wides=['x', '']" in told["heard"]
    assert "few=[0.5]" in told["heard"]
    assert "bytes=[b'\\xff']" in told["heard"]
    assert told["hash"].startswith("RIHS01_")


def test_topic_service_and_action_without_a_compiler(tmp_path: Path) -> None:
    folder = own.write(tmp_path / "own_interfaces")
    right(conversation(folder, folder))

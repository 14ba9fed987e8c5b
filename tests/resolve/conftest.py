from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_ORACLE = Path(__file__).with_name("rcl_oracle.py")


@pytest.fixture(scope="session")
def ask_rcl() -> Iterator[Callable[..., Any]]:
    """Ask the real rcl, in a process of its own; `rcl_oracle.py` lists the questions."""
    pytest.importorskip("rclpy", reason="needs ROS")
    environment = {**os.environ, "ROS_DOMAIN_ID": "70", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    with subprocess.Popen(
        [sys.executable, str(_ORACLE)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env=environment,
        text=True,
        encoding="utf-8",
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        asked, answers = process.stdin, process.stdout

        def ask(ask: str, **question: Any) -> Any:
            asked.write(json.dumps({"ask": ask, **question}) + "\n")
            asked.flush()
            answer = answers.readline()
            assert answer, "the oracle is gone"
            return json.loads(answer)

        yield ask
        process.stdin.close()

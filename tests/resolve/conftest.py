from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

_ORACLE = Path(__file__).with_name("rcl_oracle.py")


def _told(process: subprocess.Popen[str], errors: TextIO) -> str:
    """Return why there is no answer: how the process has ended, and what it said last."""
    errors.seek(0)
    return f"the oracle has ended with {process.wait(10)}: {errors.read()[-1_000:]}"


@pytest.fixture(scope="session")
def ask_rcl() -> Iterator[Callable[..., Any]]:
    """Ask the real rcl, in a process of its own; `rcl_oracle.py` lists the questions."""
    pytest.importorskip("rclpy", reason="needs ROS")
    environment = {**os.environ, "ROS_DOMAIN_ID": "70", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    with (
        tempfile.TemporaryFile("w+") as errors,
        subprocess.Popen(
            [sys.executable, str(_ORACLE)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=errors,
            env=environment,
            text=True,
            encoding="utf-8",
        ) as process,
    ):
        assert process.stdin is not None
        assert process.stdout is not None
        asked, answers = process.stdin, process.stdout

        def ask(ask: str, **question: Any) -> Any:
            try:
                asked.write(json.dumps({"ask": ask, **question}) + "\n")
                asked.flush()
                answer = answers.readline()
            except BaseException:
                # The time is up: the next example must not wait for this answer, nor take it for its own.
                process.kill()
                raise
            assert answer, _told(process, errors)
            return json.loads(answer)

        yield ask
        process.stdin.close()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()  # it may be held up as it gives back its participant

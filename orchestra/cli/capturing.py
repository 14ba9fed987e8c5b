"""Asks a running node what it declares: a process with rclpy is started for it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.declared.capturing.model import captured
from orchestra.errors import RunError, UsageError
from orchestra.nearest import nearest
from orchestra.supervise.environment import middleware, node_environment
from orchestra.supervise.host import this_host
from orchestra.supervise.keeping.marks import PROCESS, RUN

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.declared.capturing.model import Captured
    from orchestra.supervise.runs.registry import Run

# By its file and with `-P`: with `-m`, modules in the user's working directory would come before all others.
_COMMAND: Final = (
    sys.executable,
    "-P",
    str(Path(__file__).parents[1] / "ros" / "capture" / "__main__.py"),
)
# What starting rclpy may take beside the time that the node is given, in seconds.
_START: Final = 60.0
_SHOWN: Final = 8


def capture(node: str, environment: Mapping[str, str], *, timeout: float, interfaces: bool) -> Captured:
    """Return what a node declares; `environment` says how it is reached. Raises `RunError` where it cannot be asked.

    Raises `UsageError` for what cannot be the full name of a node.
    """
    full = node if node.startswith("/") else f"/{node}"
    if full.endswith("/") or "//" in full:
        raise UsageError(f"'{node}' is no full name of a node, as /robot1/driver")
    answer = _answer(
        {"node": full, "timeout": timeout, "interfaces": interfaces}, environment, timeout + _START
    )
    reason = answer.get("reason")
    if reason is None:
        return captured(full, answer)
    if reason != "absent":
        raise RunError(f"cannot ask {full}: {reason} within {timeout:g} s")
    raise RunError(_absent(full, answer["nodes"], timeout))


def environment_of(run: Run | None, log_folder: str) -> dict[str, str]:
    """Return the environment to ask in: the caller's, with what the processes of a run have to reach each other."""
    caller = dict(os.environ)
    if run is not None:
        caller = {name: value for name, value in caller.items() if name not in middleware(caller)}
        caller |= middleware(_of_process(run.identity.supervisor))
    made = node_environment(caller, this_host(), {}, log_folder=log_folder, colour=False, marks=("", ""))
    return {name: value for name, value in made.items() if name not in (RUN, PROCESS)}


def _of_process(pid: int) -> dict[str, str]:
    """Return the environment with which a process was started. Raises `OSError`."""
    entries = Path(f"/proc/{pid}/environ").read_bytes().decode("utf-8", "surrogateescape").split("\0")
    return dict(entry.split("=", 1) for entry in entries if "=" in entry)


def _absent(full: str, nodes: list[str], timeout: float) -> str:
    near = nearest(full, nodes)
    told = f"there is no node {full}, or it was not seen within {timeout:g} s"
    if near is not None:
        return f"{told}; did you mean {near}?"
    if not nodes:
        return f"{told}; no node at all is there (ROS_DOMAIN_ID decides which are)"
    more = ", …" if len(nodes) > _SHOWN else ""
    return f"{told}; there are {', '.join(nodes[:_SHOWN])}{more}"


def _answer(question: dict[str, Any], environment: Mapping[str, str], patience: float) -> dict[str, Any]:
    try:
        done = subprocess.run(  # noqa: S603 - a program of ours
            [*_COMMAND, json.dumps(question)],
            env=dict(environment),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=patience,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise RunError(f"asking {question['node']} takes longer than {patience:g} s") from None
    if done.returncode != 0 or not done.stdout:
        last = done.stderr.decode("utf-8", "replace").strip().splitlines()[-1:] or ["it says nothing"]
        if "rclpy" in last[0]:
            raise RunError(f"asking a node needs rclpy: {last[0]}")
        raise RunError(f"the process that asks {question['node']} has failed: {last[0]}")
    answer: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return answer

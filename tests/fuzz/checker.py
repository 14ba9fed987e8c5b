"""Checks descriptions in a child each: `python checker.py` answers one JSON line for each JSON line.

A question has `files` (name to base64) and `main`, the one that is checked. The answer has the problems as data, how
the child ended, its processor time in seconds, and how much its memory grew in bytes.
"""

from __future__ import annotations

import base64
import json
import os
import resource
import sys
import traceback
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from orchestra.cli.checking import problems_in
from orchestra.cli.colour import painter
from orchestra.cli.problems.formats import FORMATS, renderer
from orchestra.cli.problems.sources import from_files
from orchestra.cli.targets import targets
from orchestra.pipeline import inputs_from

_MEMORY = 3 << 30
_SECONDS = 60
_ENVIRONMENT = {"PATH": os.environ["PATH"], "HOME": "/nonexistent"}


def answer(question: dict[str, Any]) -> dict[str, Any]:
    """Check the files of a question in a child."""
    with TemporaryDirectory() as folder:
        for name, content in question["files"].items():
            path = Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(base64.b64decode(content))
        return _in_child(folder, question["main"])


def _in_child(folder: str, main: str) -> dict[str, Any]:
    reading, writing = os.pipe()
    before = _memory()
    pid = os.fork()
    if pid == 0:
        os.close(reading)
        _check(folder, main, writing)
    os.close(writing)
    with open(reading, "rb") as stream:  # noqa: PTH123 - a descriptor
        found = stream.read()
    _, status, usage = os.wait4(pid, 0)
    return {
        **(json.loads(found) if found else {"problems": [], "raised": None}),
        "status": os.waitstatus_to_exitcode(status),
        "seconds": usage.ru_utime + usage.ru_stime,
        "grown": max(0, usage.ru_maxrss * 1024 - before),
    }


def _memory() -> int:
    pages = Path("/proc/self/statm").read_text("utf-8").split()[1]
    return int(pages) * resource.getpagesize()


def _check(folder: str, main: str, writing: int) -> None:
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CPU, (_SECONDS, _SECONDS))
    result: dict[str, Any] = {"problems": [], "raised": None}
    silent = os.open(os.devnull, os.O_WRONLY)
    os.dup2(silent, 1)
    os.dup2(silent, 2)
    try:
        os.chdir(folder)
        problems = problems_in(targets([main]), inputs_from([], environment=_ENVIRONMENT))
        sources, paint = from_files({}), painter(enabled=False)
        for name in FORMATS:
            renderer(name)(problems, sources, paint)
        result["problems"] = json.loads(renderer("json")(problems, sources, paint))
    except BaseException:  # noqa: BLE001 - whatever it is, the test is to see it
        result["raised"] = traceback.format_exc()
    os.write(writing, json.dumps(result).encode())
    os._exit(0)


def _warm_up() -> None:
    """Import what a check needs here, once for all children."""
    text = "launch: [{node: {exec: /bin/sh, name: n, param: [{name: p, value: 1}]}}, {include: {file: $(var x)}}]"
    files = {"a.yaml": text, "b.launch.xml": "<launch><node exec='/bin/sh'/></launch>"}
    with TemporaryDirectory() as folder:
        for name, content in files.items():
            Path(folder, name).write_text(content, "utf-8")
        problems = problems_in(targets([folder]), inputs_from([], environment=_ENVIRONMENT))
    for name in FORMATS:
        renderer(name)(problems, from_files({}), painter(enabled=False))


if __name__ == "__main__":
    _warm_up()
    for line in sys.stdin:
        sys.stdout.write(json.dumps(answer(json.loads(line))) + "\n")
        sys.stdout.flush()

"""What exactly is executed for a process of the plan, with every symbolic path filled in."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from orchestra.plan.parameter_file import render

if TYPE_CHECKING:
    from orchestra.plan.model import Process

RUN_FOLDER = "${run}"
_PARAMETER_FILE = re.compile(re.escape(RUN_FOLDER) + r"/params/[^\s'\"]+")


@dataclass(frozen=True, slots=True)
class Spec:
    """One program to execute. `tty` gives it a terminal for its output, `stdin` our own standard input."""

    id: str
    command: tuple[str, ...]
    environment: dict[str, str]
    cwd: str | None
    tty: bool
    stdin: bool


def located(process: Process, folder: str) -> Process:
    """Return the process with `${run}` replaced by the run directory in everything that is executed."""

    def fill(text: str) -> str:
        return text.replace(RUN_FOLDER, folder)

    return replace(
        process,
        command=tuple(fill(word) for word in process.command),
        environment={
            name: value if value is None else fill(value) for name, value in process.environment.items()
        },
        cwd=fill(process.cwd) if process.cwd is not None else None,
        arguments=tuple(fill(word) for word in process.arguments),
    )


def argv(process: Process) -> tuple[str, ...]:
    """Return the words to execute; with `shell` they are one line for it."""
    return ("/bin/sh", "-c", " ".join(process.command)) if process.shell else process.command


def parameter_texts(process: Process) -> dict[str, str]:
    """Return the parameter files of a process, path to content; paths still begin with `${run}`.

    What is passed on for other nodes stands in the plan word by word; the remaining file that the command names is the
    node's own.
    """
    texts = {file.path: file.content for file in process.parameter_files}
    named = [path for word in process.command for path in _PARAMETER_FILE.findall(word)]
    own = {path: render(process) for path in named if path not in texts}
    return {**texts, **own}

"""What exactly is executed for a process of the plan, with every symbolic path filled in."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.fields import replace

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.plan.model import Process
    from orchestra.values import ParameterValue

RUN_FOLDER = "${run}"


@dataclass(frozen=True, slots=True)
class Spec:
    """One program to execute.

    `tty` gives it a terminal for each of its outputs, `stdin` our own standard input. The `foremost` has instead of all
    that one terminal for everything, which controls it: job control and questions for a password work there (setsid(2),
    ioctl_tty(2)).

    `mark` is the number by which it can be told (`keeping.marks`), None for that of the run.
    `before_exec` is called in the child, after the fork and before the program begins; where it raises, nothing runs.
    """

    id: str
    command: tuple[str, ...]
    environment: dict[str, str]
    cwd: str | None
    tty: bool
    stdin: bool
    before_exec: Callable[[], None] | None = None
    foremost: bool = False
    mark: int | None = None


def located(process: Process, folder: str) -> Process:
    """Return the process with `${run}` replaced by the run directory in all that it is told."""
    if not _names_the_run(process):
        return process

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
        parameters=filled(process.parameters, folder),
    )


def _names_the_run(process: Process) -> bool:
    words = (*process.command, *process.arguments, process.cwd or "", *process.environment.values())
    return RUN_FOLDER in "\0".join(filter(None, words)) or RUN_FOLDER in str(process.parameters)


def filled(values: Mapping[str, ParameterValue], folder: str) -> dict[str, ParameterValue]:
    """Return parameter values with `${run}` replaced by the run directory."""
    return {
        name: _filled(value, lambda text: text.replace(RUN_FOLDER, folder)) for name, value in values.items()
    }


def _filled(value: ParameterValue, fill: Callable[[str], str]) -> ParameterValue:
    if isinstance(value, str):
        return fill(value)
    if isinstance(value, tuple):
        return tuple(fill(item) if isinstance(item, str) else item for item in value)  # type: ignore[return-value] # as before
    return value


def argv(process: Process) -> tuple[str, ...]:
    """Return the words to execute; with `shell` they are one line for it."""
    return ("/bin/sh", "-c", " ".join(process.command)) if process.shell else process.command

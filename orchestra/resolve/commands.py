"""Runs the commands of `$(command)` and of xacro files.

Each runs below a process of its own, `command_reaper`, which costs some 30 ms and ends whatever the command leaves
behind, detached processes included, however the command ends. The command may outlive neither that process nor this
one: losing its caller is the order to end.
"""

from __future__ import annotations

import marshal
import os
import selectors
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO, TYPE_CHECKING, Final

from orchestra.resolve.context import CommandResult

if TYPE_CHECKING:
    from collections.abc import Mapping

_REAPER: Final = Path(__file__).with_name("command_reaper.py")
_GRACE: Final = 5.0  # seconds for the reaper to end everything
_CHUNK: Final = 1 << 16
_MEBIBYTE: Final = 1 << 20


def run_command(
    argv: tuple[str, ...],
    environment: Mapping[str, str],
    *,
    timeout: float = 30.0,
    limit: int = 64 * _MEBIBYTE,
) -> CommandResult:
    """Run a command without a shell or input, in a session of its own, and return what it printed, read as UTF-8.

    `timeout` is in seconds, `limit` in bytes of standard output and error together; passing either ends the command.
    The program is looked for on the PATH of `environment`. What the command cannot do is told in `failure`.
    """
    reading, writing = os.pipe()
    with open(reading, "rb") as report:  # noqa: PTH123 - a descriptor, not a path
        try:
            reaper = subprocess.Popen(  # noqa: S603 - running what the launch file says is what $(command) is
                [sys.executable, "-I", "-S", _REAPER, str(writing)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                bufsize=0,
                pass_fds=(writing,),
                start_new_session=True,
            )
        finally:
            os.close(writing)
        with reaper:
            control, stdout, stderr = _pipes(reaper)
            _order(control, argv, environment)
            output = _Output({stdout.fileno(): [], stderr.fileno(): [], report.fileno(): []})
            failure = _gather(output, timeout, limit)
            if failure is not None:
                control.close()
                if _gather(output, _GRACE, None) is not None:
                    reaper.kill()
                    failure += " and could not be ended"
    return _result(*output.texts(), failure)


@dataclass(slots=True)
class _Output:
    """What has been read, by descriptor; a descriptor at its end is no longer open."""

    chunks: dict[int, list[bytes]]
    open: set[int] = field(init=False)
    size: int = 0

    def __post_init__(self) -> None:
        self.open = set(self.chunks)

    def texts(self) -> tuple[str, str, str]:
        stdout, stderr, report = (
            b"".join(chunks).decode("utf-8", "replace") for chunks in self.chunks.values()
        )
        return stdout, stderr, report


def _pipes(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes], IO[bytes]]:
    if process.stdin is None or process.stdout is None or process.stderr is None:
        raise AssertionError("the process was started with three pipes")
    return process.stdin, process.stdout, process.stderr


def _order(control: IO[bytes], argv: tuple[str, ...], environment: Mapping[str, str]) -> None:
    """Tell the reaper what to run; its end, if it is gone already, shows in that nothing is reported."""
    left = memoryview(marshal.dumps((list(argv), dict(environment))))
    try:
        while left:
            left = left[os.write(control.fileno(), left) :]
    except BrokenPipeError:
        return


def _gather(output: _Output, timeout: float, limit: int | None) -> str | None:
    """Read until every descriptor ends; return what kept that from happening. Without a limit nothing is kept."""
    deadline = time.monotonic() + timeout
    with selectors.DefaultSelector() as selector:
        for descriptor in output.open:
            selector.register(descriptor, selectors.EVENT_READ)
        while output.open:
            for key, _ in selector.select(max(0.0, deadline - time.monotonic())):
                chunk = os.read(key.fd, _CHUNK)
                if not chunk:
                    selector.unregister(key.fd)
                    output.open.remove(key.fd)
                elif limit is not None:
                    output.chunks[key.fd].append(chunk)
                    output.size += len(chunk)
            if limit is not None and output.size > limit:
                return f"printed more than {limit / _MEBIBYTE:g} MiB"
            if output.open and time.monotonic() >= deadline:
                return f"ran longer than {timeout:g} s"
    return None


def _result(stdout: str, stderr: str, report: str, failure: str | None) -> CommandResult:
    told = dict(line.split(" ", 1) for line in report.splitlines())
    status = int(told.get("status", -signal.SIGKILL))
    if "failed" in told:
        failure = f"cannot be started: {told['failed']}"
    elif failure is None and "status" not in told:
        failure = "was ended together with the process above it"
    return CommandResult(status, stdout, stderr, failure)

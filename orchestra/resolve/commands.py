"""Runs the commands of `$(command)` and of xacro files.

Each runs below a process of its own, `command_reaper`, which costs some 30 ms and ends whatever the command leaves
behind, detached processes included, however the command ends. The command may outlive neither that process nor this
one: losing its caller is the order to end, and where the reaper is killed its caller inherits what it had below it, and
ends that.
"""

from __future__ import annotations

import contextlib
import marshal
import os
import sys
import time
from _signal import SIGKILL  # type: ignore[import-not-found] # `signal` makes enumerations first
from pathlib import Path
from typing import IO, TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.resolve.context import CommandResult

if TYPE_CHECKING:
    import subprocess
    from collections.abc import Callable, Iterator, Mapping

_REAPER: Final = Path(__file__).with_name("command_reaper.py")
_GRACE: Final = 5.0  # seconds for the reaper to end everything, and for us where it is dead
_LOOK_AGAIN: Final = 0.02
_UNKEPT: Final = "was ended because its keeper, the process above it, was ended"
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
    import subprocess  # noqa: PLC0415 - slow, and few launch files run commands

    reading, writing = os.pipe()
    with open(reading, "rb") as report, _inheriting() as end_orphans:  # noqa: PTH123 - a descriptor, not a path
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
            output = _Output(report.fileno(), (stdout.fileno(), stderr.fileno()))
            failure = _gather(output, timeout, limit)
            if failure is not None:
                control.close()
                _await_end(reaper)
                if not end_orphans():
                    failure += " and could not be ended"
    return _result(*output.texts(), failure)


@contextlib.contextmanager
def _inheriting() -> Iterator[Callable[[], bool]]:
    """Inherit what a dead reaper leaves behind; what is given ends that, and tells whether all of it is gone.

    Only children that were there before are told apart from it. So nothing may start others meanwhile, and nothing
    does: descriptions are evaluated one step after the other.
    """
    from orchestra.resolve.command_reaper import children, set_subreaper  # noqa: PLC0415 - few run any

    spared = set(children())
    before = set_subreaper(1)
    try:
        yield lambda: _end_orphans(spared)
    finally:
        set_subreaper(before)


def _end_orphans(spared: set[int]) -> bool:
    from orchestra.resolve.command_reaper import children, kill  # noqa: PLC0415 - as above

    deadline = time.monotonic() + _GRACE
    while left := set(children()) - spared:
        for child in left:
            with contextlib.suppress(ProcessLookupError, ChildProcessError):  # where SIGCHLD is ignored
                kill(child)
                os.waitpid(child, os.WNOHANG)
        if time.monotonic() >= deadline:
            return False
        time.sleep(_LOOK_AGAIN)
    return True


def _await_end(reaper: subprocess.Popen[bytes]) -> None:
    import subprocess  # noqa: PLC0415 - as above

    try:
        reaper.wait(_GRACE)
    except subprocess.TimeoutExpired:
        reaper.kill()
        reaper.wait()


@dataclass(slots=True)
class _Output:
    """What has been read, by descriptor; a descriptor at its end is no longer open."""

    report: int
    streams: tuple[int, int]
    chunks: dict[int, list[bytes]] = field(init=False)
    open: set[int] = field(init=False)
    size: int = 0

    def __post_init__(self) -> None:
        self.chunks = {descriptor: [] for descriptor in (*self.streams, self.report)}
        self.open = set(self.chunks)

    @property
    def unkept(self) -> bool:
        """Whether the reaper is gone without a word on how the command ended."""
        return self.report not in self.open and b"status" not in b"".join(self.chunks[self.report])

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


def _gather(output: _Output, timeout: float, limit: int) -> str | None:
    """Read until every descriptor ends; return what kept that from happening.

    Where the reaper is dead nothing else is waited for: what it leaves behind may hold the streams for ever.
    """
    import selectors  # noqa: PLC0415 - as above

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
                output.chunks[key.fd].append(chunk)
                output.size += len(chunk)
            if output.unkept:
                return _UNKEPT
            if output.size > limit:
                return f"printed more than {limit / _MEBIBYTE:g} MiB"
            if output.open and time.monotonic() >= deadline:
                return f"ran longer than {timeout:g} s"
    return None


def _result(stdout: str, stderr: str, report: str, failure: str | None) -> CommandResult:
    told = dict(line.split(" ", 1) for line in report.splitlines())
    status = int(told.get("status", -SIGKILL))
    if "failed" in told:
        failure = f"cannot be started: {told['failed']}"
    return CommandResult(status, stdout, stderr, failure)

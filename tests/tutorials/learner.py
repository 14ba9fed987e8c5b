"""Types what a page says, and sees what is written."""

from __future__ import annotations

import os
import select
import signal
import subprocess
import time
from contextlib import ExitStack, contextmanager, suppress
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from tests.tutorials.pages import Command, File

# In seconds. Whoever follows a page types slowly: what is not yet there is looked at again.
_PATIENCE = 60.0
_EACH = 100.0
# What only looks can be typed again.
_LOOKS = (
    "orchestra graph", "orchestra doctor", "orchestra ps", "orchestra tf",
    *(f"orchestra {word} {verb}" for word in ("node", "topic", "service", "param", "action", "lifecycle", "component")
      for verb in ("list", "info", "get", "echo", "hz", "type", "types", "find", "describe", "nodes")),
)  # fmt: skip
# Variables and the folder are those that the command before has left.
_SHELL = """\
if [ -e {state} ]; then . {state}; fi
{{ {command}
}}
status=$?
{{ export -p; echo "cd '$PWD'"; }} > {state}
exit $status
"""


class Learner:
    """Works in a folder, with as many terminals as it takes."""

    def __init__(self, folder: Path, state: Path, environment: Mapping[str, str], lasting: ExitStack) -> None:
        self._folder = folder
        self._state = state
        self._environment = dict(environment)
        self._lasting = lasting
        self._others = 0

    def save(self, file: File) -> None:
        """Write a file."""
        path = self._folder / file.name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(file.text)

    def type(self, command: Command) -> None:
        """Type a command; `AssertionError` where something else is seen than the page shows."""
        if command.elsewhere:
            self._lasting.enter_context(self._going_on(command))
        elif command.interrupted:
            with self._going_on(command):
                pass
        else:
            self._once(command)

    def _once(self, command: Command) -> None:
        deadline = time.monotonic() + _PATIENCE
        while True:
            status, output = self._answer(command)
            if status == 0 and (not command.seen or command.fits(output)):
                return
            if not command.text.startswith(_LOOKS) or time.monotonic() > deadline:
                shown = "\n".join(command.seen)
                raise AssertionError(f"$ {command.text}\n{output}\n(status {status}), and not\n{shown}")

    def _answer(self, command: Command) -> tuple[int, str]:
        done = subprocess.run(
            ["bash", "-c", _SHELL.format(command=command.text, state=self._state)],
            cwd=self._folder,
            env=self._environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=_EACH,
            check=False,
        )
        return done.returncode, done.stdout

    @contextmanager
    def _going_on(self, command: Command) -> Iterator[None]:
        """Have a command work in another terminal until it has shown what it shows, and longer; then Ctrl-C."""
        script = f"if [ -e {self._state} ]; then . {self._state}; fi\nexec {command.text}"
        with subprocess.Popen(
            ["bash", "-c", script],
            cwd=self._folder,
            env=self._environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        ) as process:
            try:
                self._await(command, process)
                yield
            finally:
                with suppress(ProcessLookupError):
                    os.killpg(process.pid, signal.SIGINT)
                    self._drain(process)

    def _await(self, command: Command, process: subprocess.Popen[bytes]) -> None:
        assert process.stdout is not None
        seen, deadline = b"", time.monotonic() + _PATIENCE
        while not command.fits(seen.decode(errors="replace")) if command.seen else False:
            ready, _, _ = select.select([process.stdout], [], [], max(0.0, deadline - time.monotonic()))
            part = os.read(process.stdout.fileno(), 1 << 16) if ready else b""
            seen += part
            if not part:
                raise AssertionError(
                    f"$ {command.text}\n{seen.decode(errors='replace')}\nand not {command.seen}"
                )

    @staticmethod
    def _drain(process: subprocess.Popen[bytes]) -> None:
        try:
            process.communicate(timeout=_PATIENCE)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            raise

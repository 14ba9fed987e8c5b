"""Small programs that are started to find something out: each has a limit of time, and leaves nothing behind.

Each runs in a session of its own, without input. When it has ended, has taken too long or is not wanted any more, its
whole group gets SIGKILL: what it leaves running would pile up with every attempt.
"""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING

from orchestra.supervise.keeping.kin import send_to_groups
from orchestra.supervise.process.ending import Ending, unstartable
from orchestra.supervise.process.spawn import spawn

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.probes.protocol import Cancel, Result
    from orchestra.supervise.keeping.kin import Kin
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.process.spec import Spec

_READ_SIZE = 65536
# What is kept of the end of each stream, and shown of its last line.
_KEPT = 65536
_LONGEST_LINE = 200


class Trial:
    """One such program. `told` hears what came of it, once; `gone` is called when it has been reaped."""

    def __init__(
        self,
        loop: Loop,
        kin: Kin,
        spec: Spec,
        limit: float,
        told: Callable[[Result], None],
        gone: Callable[[Trial], None],
    ) -> None:
        self._loop = loop
        self._kin = kin
        self._told: Callable[[Result], None] | None = told
        self._gone = gone
        self._reaped = False
        self._child = spawn(spec)
        kin.add(self._child.pid, None)
        self._written = dict.fromkeys(self._child.outputs, b"")
        self._reading = set(self._child.outputs)
        for name, descriptor in self._child.outputs.items():
            loop.on_readable(descriptor, lambda name=name: self._read(name))  # type: ignore[misc]
        loop.on_readable(self._child.pidfd, self._ended)
        late = _result(f"it took longer than {limit:g} s")
        self._timer = loop.call_later(limit, lambda: self._tell_and_kill(late))

    def cancel(self) -> None:
        """End it; what comes of it is not told any more."""
        self._told = None
        if not self._reaped:
            self._kill()

    def _tell_and_kill(self, result: Result) -> None:
        self._kill()
        self._tell(result)

    def _kill(self) -> None:
        self._timer.cancel()
        send_to_groups([self._child.pid], signal.SIGKILL)

    def _tell(self, result: Result) -> None:
        told, self._told = self._told, None
        if told:
            told(result)

    def _read(self, name: str) -> bool:
        """Read once; tell whether there was something."""
        try:
            data = os.read(self._child.outputs[name], _READ_SIZE)
        except BlockingIOError:
            return False
        if not data:
            self._stop_reading(name)
        self._written[name] = (self._written[name] + data)[-_KEPT:]
        return bool(data)

    def _stop_reading(self, name: str) -> None:
        if name in self._reading:
            self._reading.discard(name)
            self._loop.forget(self._child.outputs[name])
            os.close(self._child.outputs[name])

    def _ended(self) -> None:
        ended = self._child.ended()
        if ended is None:
            return
        self._kill()
        for name in self._written:
            if name in self._reading:
                self._read(name)
            self._stop_reading(name)
        self._loop.forget(self._child.pidfd)
        self._kin.remove(self._child.pid)
        self._child.reap()
        self._reaped = True
        self._gone(self)
        self._tell(_result(self._fault(Ending(*ended)), self._written["stdout"]))

    def _fault(self, ending: Ending) -> str | None:
        if ending.code == 0:
            return None
        lines = [line for name in ("stdout", "stderr") for line in _lines(self._written[name])]
        return f"{ending}: {lines[-1]}" if lines else str(ending)


def _result(fault: str | None, output: bytes = b"") -> Result:
    from orchestra.probes.protocol import Result  # noqa: PLC0415 - few runs have such programs

    return Result(fault, output)


class Trials:
    """The programs of this kind that have not been reaped."""

    def __init__(self, loop: Loop, kin: Kin) -> None:
        self._loop = loop
        self._kin = kin
        self._running: set[Trial] = set()

    @property
    def alive(self) -> bool:
        """Whether one has not been reaped."""
        return bool(self._running)

    def run(self, spec: Spec, limit: float, told: Callable[[Result], None]) -> Cancel:
        """Start one; `told` hears later what came of it, also that it could not be started."""
        try:
            trial = Trial(self._loop, self._kin, spec, limit, told, self._running.discard)
        except OSError as error:
            result = _result(str(unstartable(error)))
            return self._loop.call_later(0.0, lambda: told(result))
        self._running.add(trial)
        return trial


def _lines(written: bytes) -> list[str]:
    """Return the lines with something to see, for a message on one line."""
    text = written.decode("utf-8", "replace")
    seen = ("".join(filter(str.isprintable, line)).strip() for line in text.splitlines())
    return [line[:_LONGEST_LINE] for line in seen if line]

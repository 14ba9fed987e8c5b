"""How one run of a process ended, in data and in words."""

from __future__ import annotations

import signal

from orchestra.dataclass import dataclass

# What shells say for a program that is not there and for one that cannot be executed (POSIX.1-2017, 2.8.2).
NOT_FOUND, NOT_EXECUTABLE = 127, 126
_SIGNALLED = 128


@dataclass(frozen=True, slots=True)
class Ending:
    """Exactly one of `code` and `signal` is set; `reason` says why a program could not be started at all.

    `hang` says what sign of life a program had not given when it was ended for that.
    """

    code: int | None = None
    signal: int | None = None
    reason: str | None = None
    hang: str | None = None

    @property
    def status(self) -> int:
        """The exit status as a shell gives it: the code unchanged, 128+n for signal n."""
        return self.code if self.code is not None else _SIGNALLED + (self.signal or 0)

    def __str__(self) -> str:
        if self.reason is not None:
            return f"could not be started: {self.reason}"
        how = signal_name(self.signal or 0) if self.code is None else f"exit code {self.code}"
        return how if self.hang is None else f"it hung, {self.hang}: {how}"


def signal_name(number: int) -> str:
    """Return the name of a signal, its number where it has none."""
    try:
        return signal.Signals(number).name
    except ValueError:
        return f"signal {number}"


def unstartable(error: OSError) -> Ending:
    """Return the ending of a program that could not be started."""
    missing = isinstance(error, FileNotFoundError | NotADirectoryError)
    place = f": {error.filename}" if error.filename else ""
    return Ending(
        code=NOT_FOUND if missing else NOT_EXECUTABLE,
        reason=f"{(error.strerror or str(error)).lower()}{place}",
    )

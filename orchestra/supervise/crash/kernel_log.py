"""What the kernel's log says of a process (syslog(2)): that memory ran out, or at what address it faulted."""

from __future__ import annotations

import ctypes
import re

from orchestra.dataclass import dataclass

# SYSLOG_ACTION_READ_ALL: the last bytes of the log, which stays as it is.
_READ_ALL = 3
_SIZE = 1 << 17
_LINE = re.compile(r"(?:<\d+>)?\[ *(\d+\.\d+)\] ?(.*)")
# The log's clock is not quite that of processes; in seconds.
_SLACK = 5.0

_LIBC = ctypes.CDLL(None, use_errno=True)


@dataclass(frozen=True, slots=True)
class Line:
    """One message: when, in seconds of the monotonic clock, and what."""

    at: float
    text: str


def recent() -> list[Line]:
    """Return the latest messages, oldest first; none where the log is closed to us (dmesg_restrict)."""
    buffer = ctypes.create_string_buffer(_SIZE)
    size = _LIBC.klogctl(_READ_ALL, buffer, _SIZE)
    text = buffer.raw[: max(size, 0)].decode("utf-8", "replace")
    return [Line(float(found[1]), found[2]) for line in text.splitlines() if (found := _LINE.fullmatch(line))]


def about(pid: int, began: float, lines: list[Line]) -> list[str]:
    """Return what is said of a process since it began, which is in seconds of the monotonic clock."""
    named = re.compile(rf"\[{pid}\]:? |\b[Pp]rocess {pid} ")
    return [line.text for line in lines if line.at >= began - _SLACK and named.search(line.text)]


def tells_of_want_of_memory(lines: list[str]) -> bool:
    """Tell whether the kernel says that it ended a process because memory ran out."""
    return any("Killed process" in line for line in lines)

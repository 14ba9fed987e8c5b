"""LTTng, which the libraries below rclpy trace with, through forks: as its own liblttng-ust-fork does it.

As it is loaded it starts two threads, which it cancels when the process ends. A fork leaves threads behind, and once a
node has ended a few of its own the C library gives back the memory of those: the node's end would be a SIGSEGV.
"""

from __future__ import annotations

import ctypes
from contextlib import suppress

_NAME = "/liblttng-ust-"
_PREFIXES = ("ust_", "lttng_ust_")  # up to 2.12, and since
_SIGNALS = 128  # bytes of a sigset_t


class Tracing:
    """What LTTng wants to be told of forks; nothing where it is not loaded."""

    def __init__(self) -> None:
        self._mask = ctypes.create_string_buffer(_SIGNALS)
        self._libraries = [ctypes.CDLL(path) for path in _loaded()]

    def before_fork(self) -> None:
        """Have its locks in a known state; signals wait from now on."""
        self._call("before_fork")

    def in_parent(self) -> None:
        """Go on as before."""
        self._call("after_fork_parent")

    def in_child(self) -> None:
        """Begin anew, with threads of this process."""
        self._call("after_fork_child")

    def _call(self, what: str) -> None:
        for library in self._libraries:
            for prefix in _PREFIXES:
                with suppress(AttributeError):
                    getattr(library, prefix + what)(self._mask)


def _loaded() -> list[str]:
    try:
        with open("/proc/self/maps", encoding="utf-8") as file:  # noqa: PTH123 - on the way of the first node
            paths = {line.split(maxsplit=5)[5].strip() for line in file if _NAME in line}
    except OSError:
        return []
    return [path for path in paths if ".so" in path and "-tracepoint" not in path and "-fork" not in path]

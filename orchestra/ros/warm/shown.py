"""What /proc shows of a process: its command line and its environment, at addresses that the process itself may choose.

PR_SET_MM_MAP needs no privilege (prctl(2); kernel/sys.c, prctl_set_mm_map), but a kernel that is built with
CONFIG_CHECKPOINT_RESTORE, as those of the distributions are. Without it the node shows what the server shows; it is
told from others by its number (`marks`).
"""

from __future__ import annotations

import ctypes
import mmap
import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

# From linux/prctl.h.
_SET_MM, _SET_MM_MAP = 35, 14
_NO_FILE = 0xFFFFFFFF
# The addresses of /proc/PID/stat that struct prctl_mm_map wants back, by their fields (proc(5)).
_FIELDS = {
    "start_code": 26,
    "end_code": 27,
    "start_data": 45,
    "end_data": 46,
    "start_brk": 47,
    "start_stack": 28,
}
_AFTER_NAME = 3  # the first field behind the name of the program

_kept: list[mmap.mmap] = []


class _Map(ctypes.Structure):
    _fields_ = (
        *((name, ctypes.c_uint64) for name in ("start_code", "end_code", "start_data", "end_data")),
        *((name, ctypes.c_uint64) for name in ("start_brk", "brk", "start_stack", "arg_start", "arg_end")),
        *((name, ctypes.c_uint64) for name in ("env_start", "env_end", "auxv")),
        *((name, ctypes.c_uint32) for name in ("auxv_size", "exe_fd")),
    )


_MAP = _Map()
_LIBC = ctypes.CDLL(None)
_LIBC.sbrk.restype = ctypes.c_void_p


def prepare() -> None:
    """Find out the addresses of this process: those of its copies are the same."""
    with open("/proc/self/stat", "rb") as file:  # noqa: PTH123 - on the way of the first node
        facts = file.read().rpartition(b")")[2].split()
    for name, field in _FIELDS.items():
        setattr(_MAP, name, int(facts[field - _AFTER_NAME]))
    _MAP.exe_fd = _NO_FILE


def show(words: Sequence[str], environment: Mapping[str, str]) -> None:
    """Let /proc show this command line and this environment, as far as the kernel allows it."""
    arguments = b"".join(os.fsencode(word) + b"\0" for word in words)
    variables = b"".join(os.fsencode(f"{name}={value}") + b"\0" for name, value in environment.items())
    # Private pages: the kernel reads no others for this (mm/util.c, get_cmdline).
    memory = mmap.mmap(-1, len(arguments) + len(variables) + 1, mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    memory.write(arguments + variables)
    _kept.append(memory)
    _MAP.arg_start = ctypes.addressof(ctypes.c_char.from_buffer(memory))
    _MAP.arg_end = _MAP.env_start = _MAP.arg_start + len(arguments)
    _MAP.env_end = _MAP.env_start + len(variables)
    _MAP.brk = _LIBC.sbrk(0)
    _LIBC.prctl(_SET_MM, _SET_MM_MAP, ctypes.byref(_MAP), ctypes.sizeof(_MAP), 0)

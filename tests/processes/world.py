#!/usr/bin/env python3
"""Tells everything that a program finds around it when it begins, as one line of JSON."""

import os
import time

# Before anything opens more. The threads of tracing, which libraries of ROS begin, have a socket open for a moment.
_END = time.monotonic() + 5.0
while len(FILES := sorted(os.listdir("/proc/self/fd"))) > len("0123") and time.monotonic() < _END:  # noqa: PTH208
    os.sched_yield()

import ctypes  # noqa: E402
import faulthandler  # noqa: E402
import gc  # noqa: E402
import json  # noqa: E402
import locale  # noqa: E402
import random  # noqa: E402
import resource  # noqa: E402
import signal  # noqa: E402
import sys  # noqa: E402
import threading  # noqa: E402
import warnings  # noqa: E402
from pathlib import Path  # noqa: E402
from typing import Any  # noqa: E402

LIBC = ctypes.CDLL(None)
LIBC.getenv.restype = ctypes.c_char_p


def stream(one: Any) -> list[Any]:
    buffer = one.buffer
    return [
        *(type(one).__name__, one.name, one.mode, one.encoding, one.errors, one.line_buffering),
        *(one.write_through, type(buffer).__name__, one.isatty(), one.fileno(), buffer.name),
    ]


def signals(*names: str) -> dict[str, str]:
    """Return sets of signals, without the two that the C library has for itself."""
    lines = Path("/proc/self/status").read_text().splitlines()
    sets = dict(line.split(":\t") for line in lines if line.startswith(names))
    return {name: hex(int(numbers, 16) & ~(0b11 << 31)) for name, numbers in sets.items()}


def text(name: str) -> str:
    return Path("/proc/self", name).read_bytes().decode("utf-8", "surrogateescape")


MAIN = sys.modules["__main__"]
WORLD = {
    "main": sorted(name for name in vars(MAIN) if name.startswith("__")),
    "is main": vars(MAIN) is globals(),
    "names": [
        __name__,
        __doc__,
        __package__,
        __file__,
        globals()["__cached__"],
        type(globals()["__loader__"]).__name__,
    ],
    "spec": __spec__ and [__spec__.name, __spec__.origin],
    "builtins": type(__builtins__).__name__,
    "arguments": [sys.argv, sys.orig_argv],
    "path": sys.path,
    "interpreter": [
        sys.executable,
        getattr(sys, "_base_executable", None),
        sys.prefix,
        repr(sys.flags),
        sys._xoptions,
    ],
    "warnings": [sys.warnoptions, repr([one for one in warnings.filters if "numpy" not in repr(one)])],
    "folder": [str(Path.cwd()), os.umask(0)],
    "environment": dict(sorted(os.environ.items())),
    "environment of the C library": {
        name: (LIBC.getenv(name.encode()) or b"").decode() for name in ("GIVEN", "ROS_DOMAIN_ID", "TZ")
    },
    "streams": [*map(stream, (sys.stdin, sys.stdout, sys.stderr))],
    "streams of the interpreter": [
        sys.__stdin__ is sys.stdin,
        sys.__stdout__ is sys.stdout,
        sys.__stderr__ is sys.stderr,
    ],
    "files": FILES,
    "leads": [os.getsid(0) == os.getpid(), os.getpgrp() == os.getpid()],
    "handlers": {
        int(number): str(signal.getsignal(number)).split(" at ")[0]
        for number in signal.valid_signals()
        if signal.getsignal(number) is not None
    },
    "signals": signals("SigIgn", "SigBlk", "SigPnd"),
    "limits": {
        name: resource.getrlimit(getattr(resource, name)) for name in dir(resource) if name[:7] == "RLIMIT_"
    },
    "texts": [locale.setlocale(locale.LC_ALL), sys.getfilesystemencoding(), sys.getfilesystemencodeerrors()],
    "collector": [gc.isenabled(), gc.get_threshold(), gc.get_debug()],
    "recursion": [sys.getrecursionlimit(), sys.getswitchinterval()],
    "shown": [text("comm"), text("cmdline"), sorted(text("environ").split("\0"))],
    "thread": [
        threading.active_count(),
        threading.main_thread().name,
        threading.main_thread().native_id == os.getpid(),
        threading.current_thread() is threading.main_thread(),
    ],
    "faults": faulthandler.is_enabled(),
    "hooks": [
        sys.excepthook is sys.__excepthook__,
        sys.unraisablehook is sys.__unraisablehook__,
        threading.excepthook is threading.__excepthook__,
        sys.gettrace(),
        sys.getprofile(),
        sys.getrefcount is not None,
    ],
    "time": time.tzname,
    "scheduling": [os.nice(0), sorted(os.sched_getaffinity(0)), os.sched_getscheduler(0)],
    "kernel": [text("coredump_filter"), text("oom_score_adj"), LIBC.prctl(3, 0, 0, 0, 0)],
    "ours": [name for name in sys.modules if name.startswith("orchestra")],
    "importers": [getattr(one, "__name__", type(one).__name__) for one in sys.meta_path],
}
DRAWN = random.random()  # noqa: S311
sys.stdout.write(json.dumps({"world": WORLD, "drawn": DRAWN}) + "\n")
sys.stdout.flush()

#!/usr/bin/env python3
# ruff: noqa: T201 - it is to print
"""Ends in the way that its argument says."""

from __future__ import annotations

import atexit
import os
import signal
import sys
import threading
import traceback
from typing import Any


def inner(error: BaseException) -> None:
    raise error


def chained() -> None:
    try:
        inner(KeyError("first"))
    except KeyError as error:
        raise ValueError("second") from error


def in_thread() -> None:
    thread = threading.Thread(target=inner, args=(ValueError("in a thread"),), name="worker")
    thread.start()
    thread.join()


def hooked() -> None:
    sys.excepthook = lambda kind, error, trace: print(
        "hook", "".join(traceback.format_exception(kind, error, trace)), flush=True
    )
    inner(ValueError("hooked"))


def left() -> None:
    """Let the interpreter's end do the work: what is buffered, what is registered, a thread that goes on."""
    atexit.register(print, "at exit")
    sys.stdout.write("without an end")
    threading.Timer(0.2, print, ("from a thread",)).start()


def handled() -> None:
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(7))
    os.kill(os.getpid(), signal.SIGTERM)
    signal.pause()


WAYS = {
    "returns": lambda: None,
    "status": lambda: sys.exit(3),
    "text": lambda: sys.exit("a reason"),
    "large": lambda: sys.exit(300),
    "raises": lambda: inner(ValueError("plainly")),
    "chained": chained,
    "interrupted": lambda: inner(KeyboardInterrupt()),
    "really interrupted": lambda: os.kill(os.getpid(), signal.SIGINT),
    "thread": in_thread,
    "hook": hooked,
    "left": left,
    "at once": lambda: os._exit(5),
    "aborts": os.abort,
    "killed": lambda: os.kill(os.getpid(), signal.SIGKILL),
    "terminated": lambda: os.kill(os.getpid(), signal.SIGTERM),
    "handled": handled,
    "pipe": lambda: os.kill(os.getpid(), signal.SIGPIPE),
    "group": lambda: inner(ExceptionGroup("many", [ValueError("one"), TypeError("two")])),
}

if __name__ == "__main__":
    way: Any = WAYS[sys.argv[1]]
    way()

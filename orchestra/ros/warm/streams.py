"""Standard streams anew, for the descriptors of a node (CPython, Python/pylifecycle.c, create_stdio)."""

from __future__ import annotations

import io
import os
import sys

_STREAMS = (("stdin", 0, "r"), ("stdout", 1, "w"), ("stderr", 2, "w"))


def renew() -> None:
    """Open the three again; encoding and errors are those with which this interpreter has started."""
    for name, descriptor, mode in _STREAMS:
        before: io.TextIOWrapper = getattr(sys, f"__{name}__")
        stream = _opened(name, descriptor, mode, before)
        setattr(sys, name, stream)
        setattr(sys, f"__{name}__", stream)


def _opened(name: str, descriptor: int, mode: str, like: io.TextIOWrapper) -> io.TextIOWrapper:
    unbuffered = like.write_through
    raw_only = unbuffered and mode == "w"
    buffer = io.open(descriptor, mode + "b", 0 if raw_only else -1, closefd=False)  # noqa: SIM115, UP020 - stays open
    raw = buffer if raw_only else buffer.raw  # type: ignore[attr-defined] # of a buffered one
    raw.name = f"<{name}>"  # type: ignore[misc] # as the interpreter does it
    line_by_line = not unbuffered and (os.isatty(descriptor) or name == "stderr")
    stream = io.TextIOWrapper(
        buffer,
        encoding=like.encoding,
        errors=like.errors,
        newline="\n",
        line_buffering=line_by_line,
        write_through=unbuffered,
    )
    stream.mode = mode  # type: ignore[misc] # as the interpreter has it
    return stream

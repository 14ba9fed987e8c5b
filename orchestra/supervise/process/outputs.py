"""The pipes or terminals between a program and us, made before it is started."""

from __future__ import annotations

import os
import termios
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

from orchestra.supervise.output.terminal import our_size, set_size

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.supervise.process.spec import Spec

_NAMES = ("stdout", "stderr")
_OUTPUT_FLAGS = 1  # the index of c_oflag in what tcgetattr returns


class Ends(NamedTuple):
    """`outer` maps `stdout`, and `stderr` where that is another, to what we read, which never blocks.

    `inner` is what the program writes to as its output and its errors; of a terminal it can be read too.
    """

    outer: dict[str, int]
    inner: tuple[int, int]


@contextmanager
def opened(spec: Spec) -> Iterator[Ends]:
    """Make what a program writes to. The inner ends are closed at the end, the outer ones where the block raises.

    Raises `OSError`.
    """
    pairs: list[tuple[int, int]] = []
    try:
        _make(spec, pairs)
        for outer, _ in pairs:
            os.set_blocking(outer, False)
        yield Ends(dict(zip(_NAMES, (pair[0] for pair in pairs), strict=False)), (pairs[0][1], pairs[-1][1]))
    except BaseException:
        for outer, _ in pairs:
            os.close(outer)
        raise
    finally:
        for _, inner in pairs:
            os.close(inner)


def input_of(spec: Spec, ends: Ends) -> int | None:
    """Return what a program reads: its terminal, or our own standard input (0); None where there is nothing to read."""
    if spec.foremost:
        return ends.inner[0]
    if spec.stdin:
        return 0
    return ends.inner[0] if spec.tty else None


def _make(spec: Spec, pairs: list[tuple[int, int]]) -> None:
    """Add what was made to the pairs, of which each is an outer and an inner end."""
    for _ in range(1 if spec.foremost else len(_NAMES)):
        pairs.append(_terminal() if spec.tty or spec.foremost else os.pipe())  # noqa: PERF401 - the first is closed where the second fails


def _terminal() -> tuple[int, int]:
    outer, inner = os.openpty()
    try:
        _make_plain(inner)
    except BaseException:
        os.close(outer)
        os.close(inner)
        raise
    return outer, inner


def _make_plain(terminal: int) -> None:
    """Let bytes pass as they are (no newline becomes two characters), and give the size of our own terminal."""
    modes = termios.tcgetattr(terminal)
    modes[_OUTPUT_FLAGS] &= ~termios.OPOST
    termios.tcsetattr(terminal, termios.TCSANOW, modes)
    set_size(terminal, *our_size())

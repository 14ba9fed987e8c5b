"""The pipes or terminals between a program and us, made before it is started."""

from __future__ import annotations

import os
import termios
from contextlib import ExitStack, contextmanager
from typing import TYPE_CHECKING, NamedTuple

from orchestra.supervise.output.terminal import our_size, set_size

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.supervise.process.spec import Spec

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
    with ExitStack() as ours, ExitStack() as theirs:

        def owned(pair: tuple[int, int]) -> tuple[int, int]:
            ours.callback(os.close, pair[0])
            theirs.callback(os.close, pair[1])
            os.set_blocking(pair[0], False)
            return pair

        yield _ends(spec, owned)
        ours.pop_all()


def input_of(spec: Spec, ends: Ends) -> int | None:
    """Return what a program reads: its terminal, or our own standard input (0); None where there is nothing to read."""
    if spec.foremost:
        return ends.inner[0]
    if spec.stdin:
        return 0
    return ends.inner[0] if spec.tty else None


def _ends(spec: Spec, owned: Callable[[tuple[int, int]], tuple[int, int]]) -> Ends:
    pairs = [owned(_terminal() if spec.tty or spec.foremost else os.pipe())]
    if not spec.foremost:
        pairs.append(owned(_terminal() if spec.tty else os.pipe()))
    outer = dict(zip(("stdout", "stderr"), (pair[0] for pair in pairs), strict=False))
    return Ends(outer, (pairs[0][1], pairs[-1][1]))


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

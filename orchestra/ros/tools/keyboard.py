"""Keys, one by one, from a terminal or a pipe, as they are pressed.

A terminal is told not to wait for the end of a line, not to show what is typed, and not to suspend this process, which
would leave a robot at its last command. It is as it was before when the keyboard is closed.
"""

from __future__ import annotations

import os
import select
import sys
import termios
import tty
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

_READ_SIZE: Final = 256
_ESCAPE: Final = "\x1b"
# What terminals send for the arrows, in both of their modes (ECMA-48, and xterm's control sequences).
_ARROWS: Final = {"A": "up", "B": "down", "C": "right", "D": "left"}
_INTRODUCED: Final = ("[", "O")
_CONTROL: Final = 6  # of what tcgetattr(3) gives
_SUSPEND: Final = (termios.VSUSP,)
_DISABLED: Final = b"\0"  # _POSIX_VDISABLE of Linux


def keys_of(text: str) -> tuple[list[str], str]:
    """Return the keys of what a terminal sent, and the rest, which begins a key of which more is to come."""
    found: list[str] = []
    place = 0
    while place < len(text):
        letter = text[place]
        if letter != _ESCAPE:
            found.append(letter)
            place += 1
            continue
        if place + 1 == len(text):
            return found, text[place:]
        if text[place + 1] not in _INTRODUCED:
            found.append("escape")
            place += 1
            continue
        end = next((at for at in range(place + 2, len(text)) if text[at] >= "@"), None)
        if end is None:
            return found, text[place:]
        if end == place + 2 and text[end] in _ARROWS:
            found.append(_ARROWS[text[end]])
        place = end + 1  # other sequences are keys that mean nothing here
    return found, ""


class Keyboard:
    """What is typed on a descriptor; `ended` where nothing more can come."""

    def __init__(self, descriptor: int) -> None:
        self.ended = False
        self._descriptor = descriptor
        self._rest = ""

    def pressed(self) -> list[str]:
        """Return the keys that have been pressed since the last time, without waiting."""
        found: list[str] = []
        while not self.ended and select.select([self._descriptor], [], [], 0)[0]:
            try:
                data = os.read(self._descriptor, _READ_SIZE)
            except OSError:  # the terminal has hung up
                data = b""
            if not data:
                self.ended = True
            keys, self._rest = keys_of(self._rest + data.decode(errors="replace"))
            found += keys
        return found


@contextmanager
def keyboard() -> Iterator[Keyboard]:
    """Hear the keys of standard input."""
    descriptor = sys.stdin.fileno()
    if not os.isatty(descriptor):
        yield Keyboard(descriptor)
        return
    before = termios.tcgetattr(descriptor)
    tty.setcbreak(descriptor)
    modes = termios.tcgetattr(descriptor)
    for key in _SUSPEND:
        modes[_CONTROL][key] = _DISABLED
    termios.tcsetattr(descriptor, termios.TCSADRAIN, modes)
    try:
        yield Keyboard(descriptor)
    finally:
        termios.tcsetattr(descriptor, termios.TCSADRAIN, before)

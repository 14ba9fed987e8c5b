"""The user's terminal as the source of input: what is typed goes to the one process with `stdin: true`.

The supervisor is in a session of its own, without a controlling terminal, so the kernel does not stop it when it reads
from a terminal in the background (it checks only processes of the terminal's own session). It has to look itself: while
the keeper is not in the foreground, what is typed is the shell's. Nothing tells that the keeper is there again (a shell
sends SIGCONT only to what was stopped), but then somebody types.
"""

from __future__ import annotations

import os
import termios
from typing import TYPE_CHECKING

from orchestra.supervise.keeping import proc, terminal_modes
from orchestra.supervise.output.terminal import Terminal, our_size

if TYPE_CHECKING:
    from orchestra.supervise.keeping.terminal_modes import Modes
    from orchestra.supervise.loop import Loop, Timer

_STDIN = 0
_READ_SIZE = 4096
# While keys are not ours we look no more often than this, in seconds, and only when there are some.
_LOOK_AGAIN = 0.5


class Console:
    """Hands keys on to a program, and the size of our terminal to all of them. `keeper` is who sits at the terminal.

    Nobody sits there where the run is `detached`: the program has its terminal, and whoever attaches to it types.
    """

    def __init__(self, loop: Loop, keeper: int, *, detached: bool) -> None:
        self._loop = loop
        self._keeper = keeper
        self._descriptor: int | None = None
        self._modes: Modes | None = None
        self._typed_to: Terminal | None = None
        self._terminals: set[Terminal] = set()
        self._held = b""
        self._listening = False
        self._timer: Timer | None = None
        self._hung_up = False
        self._detached = detached

    @property
    def interactive(self) -> bool:
        """Whether a program can be given a terminal for itself, ours or one to attach to, and none has it."""
        return self._typed_to is None and not self._hung_up and (self._detached or os.isatty(_STDIN))

    def opened(self, terminal: Terminal, *, foremost: bool) -> None:
        """A program with a terminal runs; what is typed goes to it where it is `foremost`."""
        self._terminals.add(terminal)
        if foremost:
            self._typed_to = terminal
            self._begin()

    def closed(self, terminal: Terminal) -> None:
        """The program has ended."""
        self._terminals.discard(terminal)
        if terminal is self._typed_to:
            self._typed_to = None
            self._held = b""
            self._end()

    def resize(self) -> None:
        """Our terminal may have another size: so do the programs'."""
        for terminal in self._terminals:
            terminal.resize(*our_size())

    def suspend(self) -> None:
        """The terminal is the shell's for now; the keeper has given it its modes back."""
        self._leave_alone()

    def resume(self) -> None:
        """The keeper goes on, in the foreground or not.

        That it was suspended may never have been heard: a SIGCONT takes back a SIGTSTP that still waits (signal(7)).
        """
        if self._typed_to and not self._are_keys_ours():
            self._begin()

    def drained(self) -> None:
        """The program has read what was typed."""
        held, self._held = self._held, b""
        if held and self._typed_to:
            self._hand_on(held)
        elif self._typed_to and self._timer is None:
            self._listen(wanted=True)

    def close(self) -> None:
        """Give the terminal back as it was."""
        self._end()
        if self._descriptor is not None:
            os.close(self._descriptor)
            self._descriptor = None

    def _begin(self) -> None:
        """Listen to the keys where it is our turn, and for it where it is not."""
        if self._hung_up or self._detached:
            return
        self._forget_timer()
        try:
            if self._descriptor is None:
                self._descriptor = _open_anew()
            if self._in_foreground():
                self._modes = terminal_modes.pass_keys_on(_STDIN)
        except (OSError, termios.error):
            self._hang_up()
            return
        self._listen(wanted=not self._held)

    def _leave_alone(self) -> None:
        """Let the shell have the keys, and look later."""
        self._listen(wanted=False)
        self._modes = None
        if self._typed_to and self._timer is None:
            self._timer = self._loop.call_later(_LOOK_AGAIN, self._begin)

    def _forget_timer(self) -> None:
        if self._timer:
            self._timer.cancel()
            self._timer = None

    def _end(self) -> None:
        self._forget_timer()
        self._listen(wanted=False)
        if not self._detached and self._in_foreground():
            terminal_modes.give_back(self._modes)
        self._modes = None

    def _listen(self, *, wanted: bool) -> None:
        if self._descriptor is None or wanted == self._listening:
            return
        self._listening = wanted
        if wanted:
            self._loop.on_readable(self._descriptor, self._read)
        else:
            self._loop.forget(self._descriptor)

    def _read(self) -> None:
        if self._descriptor is None:
            return
        if not self._in_foreground():
            self._leave_alone()
            return
        if not self._are_keys_ours():
            self._begin()
        if self._hung_up:
            return
        try:
            data = os.read(self._descriptor, _READ_SIZE)
        except BlockingIOError:
            return
        except OSError:  # EIO: the terminal is gone
            data = b""
        if data:
            self._hand_on(data)
        else:
            self._hang_up()

    def _hand_on(self, data: bytes) -> None:
        if self._typed_to:
            self._held = data[self._typed_to.write(data) :]
            self._listen(wanted=not self._held)

    def _hang_up(self) -> None:
        """Nobody types any more, whether the run goes on or not."""
        self._hung_up = True
        self._listen(wanted=False)
        if self._typed_to:
            self._typed_to.hang_up()

    def _are_keys_ours(self) -> bool:
        """Tell whether keys are passed on as they are pressed, and nobody has changed that since."""
        return self._modes is not None and terminal_modes.keys_are_passed_on(_STDIN)

    def _in_foreground(self) -> bool:
        """Tell whether the keeper may read its terminal; where no shell decides about that, it may."""
        foreground = proc.foreground(self._keeper)
        return foreground is None or foreground


def _open_anew() -> int:
    """Return a descriptor of our own: O_NONBLOCK on a shared one would be set for the shell too. Raises `OSError`."""
    flags = os.O_RDONLY | os.O_NONBLOCK | os.O_NOCTTY | os.O_CLOEXEC
    return os.open(f"/proc/self/fd/{_STDIN}", flags)

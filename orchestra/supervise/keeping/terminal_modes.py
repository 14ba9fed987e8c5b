"""The modes of the user's terminal: how they are kept, changed while a program is typed to, and given back.

Only who is in the foreground may change them: in the background the shell edits its own command line with modes of its
own. The keeper gives them back too, for it outlives a supervisor that is killed.
"""

from __future__ import annotations

import os
import termios

TYPE_CHECKING = False  # the keeper carries this module
if TYPE_CHECKING:
    from typing import Any, TypeAlias

    # What tcgetattr returns.
    Modes: TypeAlias = list[Any]

_INPUT, _LOCAL, _CHARACTERS = 0, 3, 6
# Keys arrive as they are pressed, one by one, unseen: the program's own terminal decides what becomes of them, and
# shows them. Those that make signals still do, for Ctrl-C ends the run as everywhere; so does Ctrl-S.
_INPUT_OFF = termios.ICRNL | termios.INLCR | termios.IGNCR | termios.ISTRIP
_LOCAL_OFF = termios.ICANON | termios.ECHO | termios.ECHONL | termios.IEXTEN


def kept(descriptor: int = 0) -> Modes | None:
    """Return the modes of a terminal, None where it is none or another process group is in its foreground."""
    try:
        return termios.tcgetattr(descriptor) if _ours(descriptor) else None
    except (OSError, termios.error):
        return None


def give_back(modes: Modes | None, descriptor: int = 0) -> None:
    """Let the terminal have its modes again; nothing where it is gone, or somebody else's by now."""
    try:
        if modes is not None and _ours(descriptor) and termios.tcgetattr(descriptor) != modes:
            termios.tcsetattr(descriptor, termios.TCSANOW, modes)
    except (OSError, termios.error):
        return


def pass_keys_on(descriptor: int) -> Modes:
    """Let keys arrive as they are pressed; return the modes as they were. Raises `termios.error`, `OSError`."""
    before = termios.tcgetattr(descriptor)
    modes = termios.tcgetattr(descriptor)
    modes[_INPUT] &= ~_INPUT_OFF
    modes[_LOCAL] &= ~_LOCAL_OFF
    characters = list(modes[_CHARACTERS])
    characters[termios.VMIN], characters[termios.VTIME] = 1, 0
    modes[_CHARACTERS] = characters
    termios.tcsetattr(descriptor, termios.TCSANOW, modes)
    return before


def keys_are_passed_on(descriptor: int) -> bool:
    """Tell whether keys arrive as they are pressed; False where the terminal is gone."""
    try:
        modes = termios.tcgetattr(descriptor)
    except (OSError, termios.error):
        return False
    return not (modes[_INPUT] & _INPUT_OFF or modes[_LOCAL] & _LOCAL_OFF)


def _ours(descriptor: int) -> bool:
    """Tell whether we are in the foreground, of the terminal that controls us."""
    try:
        return os.tcgetpgrp(descriptor) == os.getpgrp()
    except OSError:  # it controls another session, or none: nobody's turn but ours
        return os.isatty(descriptor)

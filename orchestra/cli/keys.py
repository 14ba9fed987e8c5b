"""What somebody types at an attached process, and the two ways to say that it is enough."""

from __future__ import annotations

_PLACE, _QUIT = b"\x10", b"\x11"  # Ctrl-P Ctrl-Q, as of a container engine
_TILDE, _DOT = b"~", b"."  # at the begin of a line, as of a remote shell
_LINE_ENDS = b"\r\n"


class Keys:
    """Tells what is typed from what leaves: Ctrl-P Ctrl-Q, or `~.` at the begin of a line (there `~~` is one `~`)."""

    def __init__(self) -> None:
        self._held = b""
        self._at_begin = True

    def typed(self, data: bytes) -> tuple[bytes, bool]:
        """Return what the process is to have, and whether the user leaves; what may still be a sign for it is held."""
        out = bytearray()
        for number in data:
            key = bytes((number,))
            if (self._held, key) in ((_PLACE, _QUIT), (_TILDE, _DOT)):
                return bytes(out), True
            if (self._held, key) == (_TILDE, _TILDE):
                self._held = b""
                self._at_begin = False
                out += key
                continue
            out += self._held
            self._held = b""
            if key == _PLACE or (key == _TILDE and self._at_begin):
                self._held = key
            else:
                out += key
            self._at_begin = key in _LINE_ENDS
        return bytes(out), False

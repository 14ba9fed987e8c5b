from __future__ import annotations

import pytest

from orchestra.cli.keys import Keys


@pytest.mark.parametrize(
    ("typed", "sent", "leaves"),
    [
        (b"hello\r", b"hello\r", False),
        (b"a\x10\x11b", b"a", True),
        (b"a\x10b", b"a\x10b", False),
        (b"\x10\x10\x11", b"\x10", True),
        (b"\x11", b"\x11", False),
        (b"~.", b"", True),
        (b"x~.", b"x~.", False),
        (b"x\r~.", b"x\r", True),
        (b"x\n~.", b"x\n", True),
        (b"~~.", b"~.", False),
        (b"~x", b"~x", False),
        (b"~", b"", False),
        (b"~\r~.", b"~\r", True),
        (b"\x10\r~.", b"\x10\r", True),
        (bytes(range(0x12, 0x7E)), bytes(range(0x12, 0x7E)), False),
    ],
)
def test_what_is_typed_and_what_leaves(typed: bytes, sent: bytes, leaves: bool) -> None:
    assert Keys().typed(typed) == (sent, leaves)
    keys = Keys()
    out = b""
    for number in typed:
        piece, left = keys.typed(bytes((number,)))
        out += piece
        if left:
            break
    assert (out, left) == (sent, leaves)

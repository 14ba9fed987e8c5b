from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from orchestra.logs.terminal_text import for_screen, harmless, plain

# Bytes that mean something to a terminal, or look as if they did, more often than chance would have it.
_PIECES = st.sampled_from(
    [b"\x1b[31m", b"\x1b[0m", b"\x1b[", b"\x1b", b"\x1b[2K", b"\n", b"\r", b"\t", b"\xc2", b"\x85", b"\x00", b"a", b"31m",
     "é".encode(), "\u2028".encode(), b"\xff"]
)  # fmt: skip
OUTPUT = st.lists(_PIECES | st.binary(max_size=5), max_size=12).map(b"".join)


@given(OUTPUT)
def test_what_is_clean_is_shown_as_every_other_output_is(data: bytes) -> None:
    assert for_screen(data, clean=harmless(plain(data))) == for_screen(data, clean=False)


@given(OUTPUT, st.sampled_from([1, 2000]))
def test_only_text_without_controls_is_clean(data: bytes, times: int) -> None:
    bare = plain(data * times)
    text = bare.decode("utf-8", "surrogateescape")
    assert harmless(bare) == all(
        character in "\n\t" or not (ord(character) < 0x20 or 0x7F <= ord(character) < 0xA0 or 0xDC80 <= ord(character) <= 0xDCFF)
        for character in text
    )  # fmt: skip

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.logs.lines import LONGEST_HELD, Lines


@given(st.lists(st.one_of(st.binary(max_size=20), st.text(max_size=9).map(str.encode)), max_size=20))
def test_every_byte_comes_back_however_it_was_cut(pieces: list[bytes]) -> None:
    lines = Lines()
    assert b"".join(map(lines.feed, pieces)) + lines.close() == b"".join(pieces)


@given(st.lists(st.binary(max_size=20), max_size=20))
def test_what_is_given_ends_with_a_line(pieces: list[bytes]) -> None:
    lines = Lines()
    assert all(text.endswith(b"\n") for piece in pieces if (text := lines.feed(piece)))


@pytest.mark.conforms("4.10 unit", "D34")
def test_a_cut_character_is_held_until_the_rest_is_there() -> None:
    lines = Lines()
    assert lines.feed("é".encode()[:1]) == b""
    assert lines.flush() == b""
    assert lines.feed("é".encode()[1:]) == b""
    assert lines.flush() == "é".encode()


def test_an_unfinished_line_can_be_had() -> None:
    lines = Lines()
    assert lines.feed(b"one\ntwo") == b"one\n"
    assert lines.unfinished
    assert lines.flush() == b"two"
    assert not lines.unfinished
    assert lines.feed(b" three\n") == b" three\n"


def test_an_endless_line_is_given_in_pieces() -> None:
    lines = Lines()
    given = b"".join(lines.feed(b"x" * 1000) for _ in range(200))
    assert len(given) > 200 * 1000 - LONGEST_HELD - 1000


@pytest.mark.parametrize("cut", range(1, 6))
def test_a_colour_cut_by_a_read_stays_in_one_piece(cut: int) -> None:
    lines, colour = Lines(), b"\x1b[31m"
    assert lines.feed(b"a" + colour[:cut]) == b""
    before = lines.flush()
    assert before == (b"a" if cut < len(colour) else b"a\x1b[31m")
    assert before + lines.feed(colour[cut:] + b"red\n") == b"a\x1b[31mred\n"


def test_what_only_looks_like_the_begin_of_a_colour_is_given_at_the_end() -> None:
    lines = Lines()
    lines.feed(b"x\x1b[")
    assert lines.flush() == b"x"
    assert lines.flush() == b""
    assert lines.unfinished
    assert lines.close() == b"\x1b["

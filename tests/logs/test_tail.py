from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from orchestra.logs.tail import Tail


@given(st.lists(st.text("ab\n", max_size=12), max_size=12))
def test_it_is_the_end_of_all_that_was_fed(pieces: list[str]) -> None:
    tail = Tail(3)
    for piece in pieces:
        tail.feed(piece.encode())
    lines = "".join(pieces).split("\n")
    assert tail.lines == tuple(lines if lines[-1] else lines[:-1])[-3:]


def test_colours_go_and_long_lines_lose_their_begin() -> None:
    tail = Tail()
    tail.feed(b"\x1b[31mred\x1b[0m\n" + b"x" * 5000 + b"end\n")
    assert tail.lines[0] == "red"
    assert tail.lines[1].endswith("xend")
    assert len(tail.lines[1]) == 500

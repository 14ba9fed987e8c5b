from __future__ import annotations

import os

import pytest

from orchestra.logs.screen import Screen
from orchestra.logs.sheets import Sheet
from orchestra.logs.terminal_text import harmless, plain

Pieces = list[tuple[str, str]]


def shown(pieces: Pieces) -> str:
    readable, writable = os.pipe()
    screen = Screen(writable, lambda _wanted: None)
    sheet = Sheet(screen, colour=False)
    for source, text in pieces:
        data = text.encode()
        sheet.write(source, f"[{source}] ".encode(), data, clean=harmless(plain(data)))
    sheet.end()
    screen.close()
    os.close(writable)
    with os.fdopen(readable, "rb") as file:
        return file.read().decode()


@pytest.mark.parametrize(
    ("pieces", "expected"),
    [
        ([("a", "10%\r"), ("a", "20%\r"), ("a", "done\n")], "[a] 10%\r[a] 20%\r[a] done\n"),
        ([("a", "\r10%"), ("a", "\r20%"), ("a", "\n")], "[a] 10%\r[a] 20%\n"),
        ([("a", "10%\r20%"), ("a", "\r30%\r"), ("a", "\n")], "[a] 20%\r[a] 30%\n"),
        ([("a", "10%\r"), ("b", "hello\n"), ("a", "20%\r"), ("a", "\n")], "[a] 10%\n[b] hello\n[a] 20%\n"),
        ([("a", "one\r\ntwo\r\n")], "[a] one\n[a] two\n"),
        ([("a", "on"), ("a", "e\r\n")], "[a] one\n"),
        ([("a", "50%\r"), ("a", "90%\rdone\nnext\n")], "[a] 50%\r[a] done\n[a] next\n"),
        ([("a", "\r"), ("a", "x\n")], "[a] x\n"),
    ],
)
def test_a_progress_bar_moves_in_its_own_line(pieces: Pieces, expected: str) -> None:
    assert shown(pieces) == expected


def test_output_that_is_let_through_stands_as_it_is_between_lines_of_others() -> None:
    readable, writable = os.pipe()
    screen = Screen(writable, lambda _wanted: None)
    sheet = Sheet(screen, colour=False)
    sheet.let_through("a", b"\x1b[2J\xff> ")
    sheet.let_through("a", b"ls\r\n")
    sheet.let_through("a", b"> ")
    sheet.write("b", b"[b] ", b"hello\n", clean=True)
    sheet.let_through("a", b"x\n")
    screen.close()
    os.close(writable)
    with os.fdopen(readable, "rb") as file:
        assert file.read() == b"\x1b[2J\xff> ls\r\n> \n[b] hello\nx\n"

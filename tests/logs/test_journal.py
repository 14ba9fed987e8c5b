from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from orchestra.logs.journal import Journal, Sheet, Sheets
from orchestra.logs.outputs import on_screen
from orchestra.logs.screen import Screen

if TYPE_CHECKING:
    from pathlib import Path


def test_output_goes_to_its_file_the_merged_file_and_the_screen(tmp_path: Path) -> None:
    readable, writable = os.pipe()
    sheet = Sheet(Screen(writable, lambda _wanted: None), colour=False)
    told: list[str] = []
    words = {"/a": None, "/b": "own_log"}
    journal = Journal(tmp_path, words, Sheets(sheet, sheet), lambda *_: None, told.append, lambda: 12.5)
    journal.output("/a", "stdout", "\x1b[32mone\x1b[0m\nhal")
    journal.output("/b", "stdout", "hidden\n")
    journal.say("two\nlines")
    journal.output("/a", "stdout", "f\n")
    journal.output("/a", "stdout", "")
    journal.close()
    assert told == ["two\nlines"]
    assert (tmp_path / "a.log").read_text() == "\x1b[32mone\x1b[0m\nhalf\n"
    assert (tmp_path / "b.log").read_text() == "hidden\n"
    assert (tmp_path / "all.log").read_text() == (
        "12.500000 [a] one\n12.500000 [a] hal\n12.500000 [b] hidden\n"
        "12.500000 [orchestra] two\n12.500000 [orchestra] lines\n12.500000 [a] f\n"
    )
    assert os.read(readable, 65536).decode() == (
        "[a] \x1b[32mone\x1b[0m\x1b[0m\n[a] hal\n[orchestra] two\n[orchestra] lines\n[a] f\n"
    )
    os.close(readable)
    os.close(writable)


def test_an_unknown_output_word_is_refused() -> None:
    with pytest.raises(ValueError, match="unknown output 'loud'"):
        on_screen("loud")

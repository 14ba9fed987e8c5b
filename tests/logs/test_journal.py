from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from orchestra.logs import records
from orchestra.logs.journal import Journal
from orchestra.logs.outputs import Output, forced_output, on_screen
from orchestra.logs.screen import Screen
from orchestra.logs.sheets import Sheet, Sheets
from tests.logs.files import writing

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.conforms("4.10 line format", "4.10 own_log files", "D70", "4.10 full")
def test_output_goes_to_its_file_the_merged_files_and_the_screen(tmp_path: Path) -> None:
    readable, writable = os.pipe()
    sheet = Sheet(Screen(writable, lambda _wanted: None), colour=False)
    told: list[str] = []
    words = {"/a": None, "/b": "own_log"}
    with writing() as writer:
        journal = Journal(tmp_path, words, Sheets(sheet, sheet), writer, told.append, lambda: 12.5)
        journal.begin("/a", 7, {})
        journal.output("/a", "stdout", b"\x1b[32mone\x1b[0m\nhal")
        journal.output("/b", "stdout", b"hidden\n")
        journal.say("two\nlines")
        journal.output("/a", "stdout", b"f\n")
        journal.output("/a", "stdout", b"")
        journal.output("/a", "stderr", b"no end")
        journal.close()
        journal.settle()
        assert journal.lost == 0
    assert told == ["two\nlines"]
    assert (tmp_path / "a.log").read_text() == "\x1b[32mone\x1b[0m\nhalf\nno end"
    assert (tmp_path / "b.log").read_text() == "hidden\n"
    assert (tmp_path / "all.log").read_text() == (
        "12.500000 [a] one\n12.500000 [a] hal\n12.500000 [b] hidden\n"
        "12.500000 [orchestra] two\n12.500000 [orchestra] lines\n12.500000 [a] f\n12.500000 [a] no end\n"
    )
    found = [(r.process, r.pid, r.stream, r.text) for r in records.read(tmp_path / "all.jsonl")]
    assert found == [
        ("/a", 7, "stdout", "one"),
        ("/b", None, "stdout", "hidden"),
        (None, os.getpid(), "orchestra", "two"),
        (None, os.getpid(), "orchestra", "lines"),
        ("/a", 7, "stdout", "half"),
        ("/a", 7, "stderr", "no end"),
    ]
    assert os.read(readable, 65536).decode() == (
        "[a] \x1b[32mone\x1b[0m\x1b[0m\n[a] hal\n[orchestra] two\n[orchestra] lines\n[a] f\n[a] no end\n"
    )
    os.close(readable)
    os.close(writable)


def test_the_file_of_a_process_has_its_bytes_and_nothing_else(tmp_path: Path) -> None:
    """Two streams that have begun lines stand there as in a terminal."""
    readable, writable = os.pipe()
    sheet = Sheet(Screen(writable, lambda _wanted: None), colour=False)
    with writing() as writer:
        journal = Journal(tmp_path, {"/a": None}, Sheets(sheet, sheet), writer, lambda _text: None)
        journal.output("/a", "stdout", b"10%\r20%")
        journal.output("/a", "stderr", b"\xff\x00oops\n")
        journal.output("/a", "stdout", b"\r30%\n")
        journal.close()
    assert (tmp_path / "a.log").read_bytes() == b"10%\r20%\xff\x00oops\n\r30%\n"
    assert os.read(readable, 65536).decode() == "[a] 20%\n[a] ??oops\n[a] 30%\n"
    os.close(readable)
    os.close(writable)


def test_an_unknown_output_word_is_refused() -> None:
    with pytest.raises(ValueError, match="unknown output 'loud'"):
        on_screen("loud")


OUT, ERR = "stdout", "stderr"


@pytest.mark.conforms("4.10 log", "4.10 screen", "4.10 both", "4.10 own_log", "4.10 full", "D34")
@pytest.mark.parametrize(
    ("output", "shown"),
    [
        (None, {OUT, ERR}),
        ("screen", {OUT, ERR}),
        ("both", {OUT, ERR}),
        ("full", {OUT, ERR}),
        ("log", {ERR}),
        ("own_log", set()),
        ({}, set()),
        ({OUT: ("screen",)}, {OUT}),
        ({OUT: ("log", "own_log"), ERR: ("screen", "log")}, {ERR}),
        ({"both": ("screen",)}, {OUT, ERR}),
        ({"both": ("log",), ERR: ("screen",)}, {ERR}),
    ],
)
def test_what_reaches_the_screen(output: Output, shown: set[str]) -> None:
    assert on_screen(output) == shown


@pytest.mark.conforms("4.10 OVERRIDE_LAUNCH_PROCESS_OUTPUT")
@pytest.mark.parametrize(
    ("variable", "show_all", "word"),
    [
        (None, False, None),
        ("", False, None),
        ("log", False, "log"),
        ("log", True, "both"),
        (None, True, "both"),
    ],
)
def test_what_counts_for_every_process(variable: str | None, show_all: bool, word: str | None) -> None:
    environment = {} if variable is None else {"OVERRIDE_LAUNCH_PROCESS_OUTPUT": variable}
    assert forced_output(environment, show_all=show_all) == word


def test_a_wish_that_is_no_word_is_refused() -> None:
    with pytest.raises(ValueError, match="unknown output 'loud'"):
        forced_output({"OVERRIDE_LAUNCH_PROCESS_OUTPUT": "loud"}, show_all=False)


def test_processes_may_be_added_and_notes_are_not_shown(tmp_path: Path) -> None:
    readable, writable = os.pipe()
    sheet = Sheet(Screen(writable, lambda _wanted: None), colour=False)
    told: list[str] = []
    with writing() as writer:
        journal = Journal(
            tmp_path,
            {"/a": "own_log"},
            Sheets(sheet, sheet),
            writer,
            told.append,
            lambda: 1.0,
            forced="both",
        )
        journal.output("/a", "stdout", b"one\n")
        journal.add({"a": None, "/longer": "log"})
        journal.output("a", "stdout", b"two\n")
        journal.output("/a", "stdout", b"three\n")
        journal.note("kept")
        journal.close()
    assert (tmp_path / "a.log").read_text() == "one\nthree\n"
    assert (tmp_path / "a~2.log").read_text() == "two\n"
    assert told == ["kept"]
    assert "1.000000 [orchestra] kept\n" in (tmp_path / "all.log").read_text()
    assert os.read(readable, 65536).decode() == "[a] one\n[a]      two\n[a]      three\n"
    os.close(readable)
    os.close(writable)

"""Lines are split as bash splits them, and words are written so that bash reads them back."""

from __future__ import annotations

import shlex
import subprocess

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.cli.completing.shell_words import split_line, written

_BREAKS = " \t\n\"'@><=;|&(:"
# What a shell's word can hold: no byte 0, and no line break, which no hook can tell.
_WORD = st.text(st.characters(exclude_characters="\0\n\r", exclude_categories=["Cs"]), min_size=1)


@pytest.mark.parametrize(
    ("text", "before", "begun", "quote", "kept"),
    [
        ("", [], "", "", 0),
        ("a", [], "a", "", 0),
        ("a ", ["a"], "", "", 0),
        ("  a   b", ["a"], "b", "", 0),
        (r"a b\ c", ["a"], "b c", "", 0),
        ("'a b' ", ["a b"], "", "", 0),
        ("'' ", [""], "", "", 0),
        ("x:=y", [], "x:=y", "", 3),
        ("x:=", [], "x:=", "", 3),
        (r"x\:y", [], "x:y", "", 0),
        ('"x:=y', [], "x:=y", '"', 0),
        ('x:="y', [], "x:=y", '"', 3),
        ("x'y", [], "xy", "'", 1),
        (r"'a\b", [], r"a\b", "'", 0),
        (r'"a\"b', [], 'a"b', '"', 0),
        (r'"a\b', [], r"a\b", '"', 0),
        ("a\\", [], "a", "", 0),
    ],
)
def test_split(text: str, before: list[str], begun: str, quote: str, kept: int) -> None:
    line = split_line(text, _BREAKS)
    assert (line.before, line.begun, line.quote, line.kept) == (before, begun, quote, kept)


@given(st.lists(_WORD), _WORD)
def test_quoted_words_come_back(words: list[str], last: str) -> None:
    line = split_line(" ".join(map(shlex.quote, [*words, last])), _BREAKS)
    assert [*line.before, line.begun] == [*words, last]


@given(_WORD, st.sampled_from(["", "'", '"']))
def test_what_is_written_is_read_as_the_word(word: str, quote: str) -> None:
    line = split_line(f"echo {quote}", _BREAKS)
    text = quote + written(word, line, finished=False) + quote
    assert split_line(text, _BREAKS).begun == word


def test_a_message_is_written_in_quotes() -> None:
    line = split_line("orchestra topic pub /a std_msgs/msg/String ", _BREAKS)
    assert written("{data: ''}", line, finished=True) == "\"{data: ''}\" "
    assert split_line(written("{a: $b}", line, finished=True), _BREAKS).before == ["{a: $b}"]


@settings(max_examples=20, deadline=None)
@given(st.lists(_WORD, min_size=1, max_size=20), st.sampled_from(["", "'", '"']))
def test_bash_reads_what_is_written(words: list[str], quote: str) -> None:
    line = split_line(f"x {quote}", _BREAKS)
    texts = " ".join(f"{quote}{written(word, line, finished=False)}{quote}" for word in words)
    read = subprocess.run(
        ["bash", "-c", rf"printf '%s\0' {texts}"], capture_output=True, text=True, check=True, timeout=60
    )
    assert read.stdout.split("\0")[:-1] == words


@pytest.mark.parametrize(
    ("begun", "expected"), [("x wor", "world "), ("x 'wor", "world"), ('x "wor', "world")]
)
def test_a_space_follows_what_is_finished_outside_quotes(begun: str, expected: str) -> None:
    assert written("world", split_line(begun, _BREAKS), finished=True) == expected

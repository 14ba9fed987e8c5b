from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.logs import records
from orchestra.logs.lines import LONGEST_HELD
from orchestra.logs.narration import Narration
from orchestra.logs.records import Record
from orchestra.logs.terminal_text import harmless, plain

HEAD = "[{}] [1700000000.123456789] [robot1.ekf]: "


def add(narration: Narration, stream: str, text: str, now: float) -> bytes:
    bare = plain(text.encode("utf-8", "surrogateescape"))
    return narration.add(stream, bare, now, clean=harmless(bare))


def told(text: str, environment: dict[str, str] | None = None) -> list[tuple[str | None, str | None, str]]:
    narration = Narration("/a")
    narration.begin(7, environment or {})
    lines = (add(narration, "stderr", text, 5.0) + narration.end(5.0)).splitlines()
    return [(record.severity, record.logger, record.text) for record in map(records.loads, lines)]


@pytest.mark.parametrize("word", ["DEBUG", "INFO", "WARN", "ERROR", "FATAL"])
def test_the_head_of_a_line_says_how_grave_it_is(word: str) -> None:
    line = HEAD.format(word) + "text"
    assert told(f"{line}\n") == [(word.lower(), "robot1.ekf", line)]
    assert told(f"\x1b[31m{line}\x1b[0m\n") == [(word.lower(), "robot1.ekf", line)]


def test_lines_of_one_message_are_as_grave_as_its_head() -> None:
    text = f"before\n{HEAD.format('ERROR')}it broke:\n  here\n\n{HEAD.format('INFO')}and on\nTraceback\n"
    assert [severity for severity, _, _ in told(text)] == [None, "error", "error", "error", "info", "info"]


def test_what_comes_later_or_on_another_stream_is_no_part_of_the_message() -> None:
    narration = Narration("/a")
    narration.begin(7, {})
    add(narration, "stderr", HEAD.format("WARN") + "x\n", 5.0)
    other = records.loads(add(narration, "stdout", "out\n", 5.0))
    late = records.loads(add(narration, "stderr", "later\n", 5.2))
    assert (other.severity, late.severity) == (None, None)


@pytest.mark.parametrize(
    ("form", "line", "expected"),
    [
        ("{severity} {name} {message}", "WARN a.b hello", ("warn", "a.b")),
        ("[{severity}]: {message} ({function_name}:{line_number})", "[FATAL]: x (main:3)", ("fatal", None)),
        ("{time_as_nanoseconds} [{name}] {message}", "1700000000123456789 [n] x", (None, "n")),
        ("{date_time_with_ms} {severity} {message}", "2024-01-02 03:04:05.678 INFO x", ("info", None)),
        ("{file_name}:{line_number} {severity}\\t{message}", "a b.cpp:12 ERROR\tx", ("error", None)),
        ("{message} <{severity}>", "hello <DEBUG>", ("debug", None)),
        ("{unknown} {severity} {message}", "{unknown} INFO x", ("info", None)),
        ("{message}", "[INFO] [1700000000.1] [a]: x", (None, None)),
        ("{severity}{name}{severity}{message}", "INFOaINFOx", ("info", "a")),
        ("", HEAD.format("INFO"), ("info", "robot1.ekf")),
        ("({severity}", "(INFO", ("info", None)),
    ],
)
def test_the_form_of_the_process_counts(
    form: str, line: str, expected: tuple[str | None, str | None]
) -> None:
    assert told(f"{line}\n", {"RCUTILS_CONSOLE_OUTPUT_FORMAT": form}) == [(*expected, line)]


@given(
    st.lists(
        st.text(
            alphabet=st.one_of(st.sampled_from('\n\\"[]{}\x00\r\t\udcff é'), st.characters(codec="utf-8")),
            max_size=30,
        )
    )
)
def test_every_line_becomes_one_record_whatever_is_in_it(pieces: list[str]) -> None:
    narration = Narration('/a"b')
    narration.begin(7, {})
    found = b"".join(add(narration, "stdout", piece, 1.25) for piece in pieces) + narration.end(1.25)
    text = "".join(pieces)
    lines = text.removesuffix("\n").split("\n") if text else []
    if "\x1b" not in text:
        expected = [Record(1.25, '/a"b', 7, "stdout", None, None, line) for line in lines]
        assert [records.loads(line) for line in found.split(b"\n")[:-1]] == expected


def test_a_line_without_end_comes_in_pieces() -> None:
    narration = Narration("/a")
    found = b"".join(add(narration, "stdout", "x" * 5000, 1.0) for _ in range(100))
    texts = [records.loads(line).text for line in found.splitlines()]
    assert texts
    assert all(len(text) <= LONGEST_HELD + 5000 for text in texts)
    rest = narration.end(1.0)
    assert "".join(texts) + (records.loads(rest).text if rest else "") == "x" * 500_000


def test_an_unfinished_line_is_told_at_the_end_under_its_own_pid() -> None:
    narration = Narration("/a")
    narration.begin(7, {})
    assert add(narration, "stdout", "no end", 1.0) == b""
    assert records.loads(narration.end(2.0)) == Record(2.0, "/a", 7, "stdout", None, None, "no end")
    assert narration.end(2.0) == b""

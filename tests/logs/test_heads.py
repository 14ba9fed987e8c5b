from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.logs import heads
from orchestra.logs.heads import DEFAULT, Run, heads_of

FORMS = (
    DEFAULT,
    "{severity} {name} {message}",
    "{date_time_with_ms} [{name}] {severity}: {message}",
    "{line_number}] {severity}",
)
# What lines of these forms are made of, so that most of those that are made up nearly have a head.
WORDS = st.sampled_from(
    ["[", "]", "] ", "] [", "]: ", " ", "INFO", "WARN", "[INFO] [1.5] [a]: ", "[WARN] [1.5] [a]: ", "INFO a ",
     "[INFO] [1.5] [ab]: ", "[INFO] [1.5] []: ", "2024-01-02 03:04:05.678 [a] INFO: ", "12] ERROR", "a", "b", "é",
     "1.5", "7", "x"]
)  # fmt: skip
LINES = st.lists(st.lists(WORDS, max_size=4).map("".join), min_size=1, max_size=8)


def line_by_line(text: bytes, runs: list[Run]) -> list[heads.Head | None]:
    """Return the head that counts for each line, where there is one."""
    told: list[heads.Head | None] = []
    begin, head = 0, None
    for end, found in runs:
        head = found or head
        told += [head] * text.count(b"\n", begin, end)
        begin = end
    assert begin == len(text)
    return told


@given(st.sampled_from(FORMS), LINES)
def test_lines_that_are_read_together_say_what_each_says_by_itself(form: str, lines: list[str]) -> None:
    text = "".join(f"{line}\n" for line in lines).encode()
    parts = heads_of(form).parts
    assert heads._ends_plainly(parts)
    together, apart = (
        line_by_line(text, list(way(parts, text))) for way in (heads._together, heads._one_by_one)
    )
    assert together == apart
    assert heads_of(form).among(text) or not any(apart)


@pytest.mark.parametrize(
    "form",
    [
        "{function_name} {severity} {message}",
        "{severity}{name}{severity}{message}",
        "{name}{time} {message}",
        "{severity} {name}{message}",
        "{name}\\n{severity}",
    ],
)
def test_forms_that_could_be_read_in_several_ways_are_read_line_by_line(form: str) -> None:
    assert not heads._ends_plainly(heads_of(form).parts)


def test_one_head_is_one_run_however_many_lines_it_counts_for() -> None:
    line = b"[INFO] [1700000000.123456789] [a]: x\n"
    text = b"before\n" + line * 1000 + b"more\n" * 1000 + line
    assert list(heads_of(DEFAULT).runs(text)) == [(7, None), (len(text), (b"INFO", b"a"))]

from __future__ import annotations

import pytest

from orchestra.cli import table


@pytest.mark.parametrize(
    ("seconds", "text"),
    [(None, "-"), (0.04, "0.0s"), (9.94, "9.9s"), (10.9, "10s"), (59.9, "59s"), (60, "1m00s"), (3599, "59m59s"),
     (3600, "1h00m"), (86399, "23h59m"), (90000, "1d01h")],
)  # fmt: skip
def test_durations(seconds: float | None, text: str) -> None:
    assert table.duration(seconds) == text


@pytest.mark.parametrize(
    ("count", "text"),
    [(None, "-"), (0, "0B"), (1023, "1023B"), (1024, "1K"), (1536 * 1024, "1.5M"), (200 << 20, "200M"),
     (3 << 30, "3.0G"), (5 << 40, "5.0T")],
)  # fmt: skip
def test_sizes(count: int | None, text: str) -> None:
    assert table.size(count) == text


def test_columns_are_aligned_and_lines_end_with_their_last_word() -> None:
    rows = [("A", "BB", "C"), ("long", "", ""), ("x", "yyy", "z")]
    assert table.aligned(rows, indent=" ") == " A     BB   C\n long\n x     yyy  z\n"
    marked = table.aligned(rows, lambda row, column, text: f"<{text}>" if (row, column) == (2, 1) else text)
    assert marked.splitlines()[2] == "x     <yyy>  z"

from __future__ import annotations

from typing import TYPE_CHECKING

from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.logs import forms, pieces, records
from orchestra.logs.pieces import Follower
from orchestra.logs.rotation import Appended, Rotation

if TYPE_CHECKING:
    from pathlib import Path

    import pytest


def rotated(path: Path, size: int = 30, keep: int = 100) -> Appended:
    return Appended(path, Rotation(size, keep), forms.RECORDS, lambda: None)


def test_pieces_come_in_the_order_in_which_they_were_written(tmp_path: Path) -> None:
    log = tmp_path / "all.jsonl"
    assert pieces.oldest_first(log) == []
    for name in ("all.jsonl", "all.jsonl.10", "all.jsonl.9", "all.jsonl.old", "b.jsonl.1"):
        (tmp_path / name).touch()
    assert [path.name for path in pieces.oldest_first(log)] == ["all.jsonl.9", "all.jsonl.10", "all.jsonl"]


@settings(deadline=None)  # real files, on a machine that may be busy
@given(st.lists(st.tuples(st.integers(0, 9), st.integers(0, 3)), max_size=40))
def test_a_follower_sees_every_line_once_however_often_the_log_is_rotated(
    tmp_path_factory: pytest.TempPathFactory, steps: list[tuple[int, int]]
) -> None:
    log = tmp_path_factory.mktemp("logs") / "a"
    file, follower = rotated(log), Follower(log)
    written, seen, count = [], [], 0
    for lines, reads in steps:
        for _ in range(lines):
            count += 1
            written.append(f"line {count:05d}\n".encode())
            assert file.append([written[-1]]) is None
        for _ in range(reads):
            seen += follower.lines()
    while found := follower.lines():
        seen += found
    assert seen == written
    follower.close()
    file.close()


def test_a_follower_from_now_on_leaves_out_what_was_before(tmp_path: Path) -> None:
    file = rotated(tmp_path / "a")
    file.append([b"one\n"] * 20)
    follower = Follower(tmp_path / "a", from_now=True)
    assert follower.lines() == []
    file.append([b"tw"])
    assert follower.lines() == []
    file.append([b"o\n", b"three\n" * 10])
    seen = []
    while found := follower.lines():
        seen += found
    assert seen == [b"two\n", *[b"three\n"] * 10]
    follower.close()
    file.close()


def test_a_follower_goes_on_where_pieces_have_been_removed(tmp_path: Path) -> None:
    file, follower = rotated(tmp_path / "a", keep=1), Follower(tmp_path / "a")
    file.append([b"first\n"])
    assert follower.lines() == [b"first\n"]
    for number in range(50):
        file.append([f"line {number}\n".encode()])
    seen = []
    while found := follower.lines():
        seen += found
    assert seen[-1] == b"line 49\n"
    assert len(seen) == len(set(seen)) < 50
    follower.close()
    file.close()


def test_records_are_read_from_every_piece_and_torn_lines_are_left_out(tmp_path: Path) -> None:
    one = records.Record(1.5, "/a", 7, "stdout", "info", "x", "é\udcff\x00")
    two = records.Record(2.5, None, None, "orchestra", None, None, "two")
    (tmp_path / "all.jsonl.1").write_text(records.dumps(one) + "\n" + records.dumps(two)[:-4] + "\n")
    (tmp_path / "all.jsonl").write_text(records.dumps(two)[:-1] + ', "later": 1}\n[]\n')
    assert list(records.read(tmp_path / "all.jsonl")) == [one, two]

from __future__ import annotations

import os
from itertools import islice
from typing import TYPE_CHECKING

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from orchestra.logs import forms, pieces, records
from orchestra.logs.pieces import Follower
from orchestra.logs.rotation import Appended, Rotation

if TYPE_CHECKING:
    from pathlib import Path


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


@settings(deadline=None)
@given(
    st.lists(st.binary(min_size=1, max_size=50).map(lambda line: line.replace(b"\n", b" ")), max_size=40),
    st.integers(1, 40),
    st.booleans(),
)
def test_a_follower_from_now_on_tells_what_was_before_from_its_end(
    tmp_path_factory: pytest.TempPathFactory, lines: list[bytes], block: int, begun: bool
) -> None:
    log = tmp_path_factory.mktemp("logs") / "a"
    file = rotated(log, size=100)
    file.append([line + b"\n" for line in lines])
    if begun:
        with log.open("ab") as more:
            more.write(b"begun")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pieces, "_READ_SIZE", block)
        follower = Follower(log, from_now=True)
        assert [*follower.before()] == [line + b"\n" for line in reversed(lines)]
    with log.open("ab") as more:
        more.write(b" rest\n")
    assert follower.lines() == [b"begun rest\n" if begun else b" rest\n"]
    follower.close()
    file.close()


def test_the_last_lines_are_read_from_the_end(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a").write_bytes(b"line\n" * 1_000_000)
    read: list[int] = []
    pread = os.pread

    def counted(descriptor: int, size: int, place: int) -> bytes:
        read.append(size)
        return pread(descriptor, size, place)

    monkeypatch.setattr(os, "pread", counted)
    follower = Follower(tmp_path / "a", from_now=True)
    assert [*islice(follower.before(), 5)] == [b"line\n"] * 5
    assert sum(read) <= 2 * pieces._READ_SIZE
    follower.close()


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

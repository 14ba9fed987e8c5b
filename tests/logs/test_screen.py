from __future__ import annotations

import fcntl
import os
import socket
from typing import TYPE_CHECKING

import pytest

from orchestra.logs.screen import BACKLOG, Screen, same_file

if TYPE_CHECKING:
    from pathlib import Path


class Watching:
    """Remembers what the screen last asked for."""

    def __init__(self) -> None:
        self.wanted = False

    def __call__(self, wanted: bool) -> None:
        assert wanted is not self.wanted
        self.wanted = wanted


def drain(readable: int) -> bytes:
    os.set_blocking(readable, False)
    found = b""
    try:
        while data := os.read(readable, 1 << 20):
            found += data
    except BlockingIOError:
        pass
    return found


def test_a_pipe_that_nobody_reads_never_blocks_us() -> None:
    readable, writable = os.pipe()
    watching = Watching()
    screen = Screen(writable, watching)
    line = b"x" * 99 + b"\n"
    for _ in range(BACKLOG // 100 + 2000):
        screen.write(line)
    assert watching.wanted
    assert screen.pending <= BACKLOG
    received = b""
    while watching.wanted:
        received += drain(readable)
        screen.writable()
    received += drain(readable)
    *shown, confession = received.splitlines()
    missed = int(confession.split()[1])
    assert set(shown) == {line[:-1]}
    assert len(shown) + missed == BACKLOG // 100 + 2000
    screen.close()
    os.close(readable)
    os.close(writable)


def test_every_line_is_shown_or_counted_wherever_texts_are_divided(monkeypatch: pytest.MonkeyPatch) -> None:
    """A line of which the screen has the begin counts as shown, and nothing follows it on its line."""
    monkeypatch.setattr("orchestra.logs.screen.BACKLOG", 100_000)
    readable, writable = os.pipe()
    watching = Watching()
    screen = Screen(writable, watching)
    lines = b"".join(b"<%d %s>\n" % (number, b"x" * (number % 97)) for number in range(20_000))
    received, place, size = b"", 0, 1
    while place < len(lines):
        screen.write(lines[place : place + size])
        place, size = place + size, size * 7 % 6_007
        if place % 11 == 0 and watching.wanted:
            received += drain(readable)
            screen.writable()
    while watching.wanted:
        received += drain(readable)
        screen.writable()
    received += drain(readable)
    told = [line for line in received.splitlines() if line.startswith(b"[orchestra] ")]
    shown = [line for line in received.splitlines() if line not in told]
    assert len(told) > 1
    assert all(line.startswith(b"<") for line in shown)
    assert len(shown) + sum(int(line.split()[1]) for line in told) == 20_000
    screen.close()
    os.close(readable)
    os.close(writable)


def test_a_line_that_is_overwritten_is_shown_again_when_there_is_room() -> None:
    readable, writable = os.pipe()
    watching = Watching()
    screen = Screen(writable, watching)
    screen.write(b"1 %")
    for text in (b"x" * BACKLOG, b"y" * BACKLOG, b" and more", b"\r2 %"):
        screen.write(text)
    received = b""
    while watching.wanted:
        received += drain(readable)
        screen.writable()
    received += drain(readable)
    begin, confession, end = received.split(b"\n")
    assert (begin, end) == (b"1 %" + b"x" * BACKLOG, b"\r2 %")
    assert confession.startswith(b"[orchestra] 1 lines")
    screen.close()
    os.close(readable)
    os.close(writable)


def test_others_who_share_the_descriptor_keep_it_blocking() -> None:
    readable, writable = os.pipe()
    screen = Screen(writable, Watching())
    assert not fcntl.fcntl(writable, fcntl.F_GETFL) & os.O_NONBLOCK
    screen.close()
    os.close(readable)
    os.close(writable)


def test_a_socket_is_written_to_with_care() -> None:
    """It cannot be opened anew."""
    ours, theirs = socket.socketpair()
    watching = Watching()
    screen = Screen(theirs.fileno(), watching)
    data = b"".join(b"%d\n" % number for number in range(100_000))
    screen.write(data)
    received = b""
    while watching.wanted:
        received += drain(ours.fileno())
        screen.writable()
    received += drain(ours.fileno())
    assert received == data
    screen.close()
    ours.close()
    theirs.close()


def test_a_file_is_written_where_the_shell_left_off(tmp_path: Path) -> None:
    path = tmp_path / "out"
    path.write_text("before\n")
    descriptor = os.open(path, os.O_WRONLY)
    os.lseek(descriptor, 0, os.SEEK_END)
    screen = Screen(descriptor, Watching())
    screen.write(b"after\n")
    screen.close()
    os.close(descriptor)
    assert path.read_text() == "before\nafter\n"


def test_a_reader_that_is_gone_is_forgotten() -> None:
    readable, writable = os.pipe()
    screen = Screen(writable, Watching())
    os.close(readable)
    screen.write(b"nobody reads this\n")
    assert screen.closed
    screen.write(b"nor this\n")
    assert screen.pending == 0
    screen.close()
    os.close(writable)


@pytest.mark.parametrize("patience", [0.0, 0.05])
def test_the_end_waits_only_for_a_screen_that_takes_something(patience: float) -> None:
    readable, writable = os.pipe()
    screen = Screen(writable, Watching())
    screen.write(b"x" * 500_000)
    screen.finish(patience)
    assert screen.pending > 0
    screen.close()
    os.close(readable)
    os.close(writable)


def test_whether_two_descriptors_are_one_place() -> None:
    readable, writable = os.pipe()
    copy, elsewhere = os.dup(writable), os.open(os.devnull, os.O_WRONLY)
    assert same_file(writable, copy)
    assert not same_file(writable, elsewhere)
    assert not same_file(writable, 10_000)
    for descriptor in (readable, writable, copy, elsewhere):
        os.close(descriptor)

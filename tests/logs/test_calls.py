"""What output costs is counted: as many calls for a block of lines as for one line."""

from __future__ import annotations

import fcntl
import os
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.logs.journal import Journal
from orchestra.logs.screen import Screen
from orchestra.logs.sheets import Sheet, Sheets
from orchestra.logs.tail import Tail
from orchestra.supervise.loop import Loop
from orchestra.supervise.output.intake import Intake
from orchestra.supervise.output.stream import Stream
from tests.logs.files import writing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

LINES = 1000
# A block of lines costs some eighty calls, most of them into C, and has at least 32 KiB.
_MOST_FOR_A_THOUSAND = 400


@pytest.fixture
def output(tmp_path: Path) -> Iterator[tuple[Loop, int, int]]:
    """What a program's output goes through; yields the loop, where to read in a stream, and where to write."""
    screen = os.open(tmp_path / "screen", os.O_WRONLY | os.O_CREAT)
    readable, writable = os.pipe()
    os.set_blocking(readable, False)
    loop, tail = Loop(), Tail(100)
    sheet = Sheet(Screen(screen, lambda _wanted: None), colour=False)
    with writing() as writer:
        journal = Journal(tmp_path, {"/a": None}, Sheets(sheet, sheet), writer, lambda _text: None)
        journal.begin("/a", 7, {})
        intake = Intake(loop, writer, lambda: None)

        def deliver(data: bytes) -> None:
            journal.output("/a", "stdout", data)
            tail.feed(data)

        stream = Stream(loop, readable, deliver, None, intake)
        yield loop, readable, writable
        os.close(writable)
        stream.close()
        journal.close()
        intake.close()
    loop.close()
    os.close(screen)


def calls(work: Callable[[], None]) -> int:
    """Return how many functions are called, those of C included; the writer's thread is not watched."""
    count = 0

    def seen(_frame: object, event: str, _argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(seen)
    try:
        work()
    finally:
        sys.setprofile(None)
    return count


@pytest.mark.parametrize(
    "line",
    [
        b"x" * 99 + b"\n",
        b"[INFO] [1700000000.123456789] [robot1.ekf]: " + b"x" * 55 + b"\n",
        b'a "quoted" \\ word\t' + b"y" * 81 + b"\n",
        b"\x1b[32m[WARN] [1700000000.123456789] [a]: " + b"x" * 55 + b"\x1b[0m\n",
    ],
)
def test_a_thousand_lines_take_no_more_calls_than_their_blocks(
    output: tuple[Loop, int, int], line: bytes
) -> None:
    loop, _readable, writable = output
    block = line * (65000 // len(line))

    def once() -> None:
        os.write(writable, block)
        loop.run_once()

    for _ in range(5):  # compiles expressions, and enlarges the pipe
        once()
    count = calls(once)
    assert count * LINES / (65000 // len(line)) < _MOST_FOR_A_THOUSAND


def test_a_busy_pipe_holds_more(output: tuple[Loop, int, int]) -> None:
    loop, readable, writable = output
    os.write(writable, b"quiet\n")
    loop.run_once()
    assert fcntl.fcntl(readable, fcntl.F_GETPIPE_SZ) == 65536
    os.write(writable, b"busy\n" * 10000)
    loop.run_once()
    assert fcntl.fcntl(readable, fcntl.F_GETPIPE_SZ) == 262144

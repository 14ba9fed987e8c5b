"""Whoever attaches to a process sees what it writes, types to it, and harms nobody by being slow."""

from __future__ import annotations

import os
import sys
from typing import TYPE_CHECKING

from orchestra.supervise.loop import Loop
from orchestra.supervise.output.attachment import LONGEST_KEPT, Attachment
from orchestra.supervise.output.stream import Stream
from orchestra.supervise.output.terminal import Terminal
from orchestra.supervise.process.spawn import spawn
from orchestra.supervise.process.spec import Spec

if TYPE_CHECKING:
    from pathlib import Path


def test_a_tap_that_is_not_emptied_keeps_the_latest_and_counts_the_rest() -> None:
    attachment, calls = Attachment(), []
    tap = attachment.tap(lambda: calls.append("wake"))
    lively = attachment.tap(lambda: None)
    for number in range(1000):
        attachment.feed(b"%07d\n" % number * 100)
        assert lively.take() == b"%07d\n" % number * 100
    assert calls == ["wake"]
    assert tap.missed == 1000 * 800 - LONGEST_KEPT
    kept = tap.take(8) + tap.take()
    assert len(kept) == LONGEST_KEPT
    assert kept.endswith(b"0000999\n")
    assert tap.take() == b""
    attachment.feed(b"x")
    assert calls == ["wake", "wake"]
    tap.close()
    attachment.feed(b"y")
    assert (tap.take(), lively.take(), lively.missed) == (b"x", b"xy", 0)


def test_a_program_with_a_terminal_is_typed_to_and_one_without_is_only_seen(tmp_path: Path) -> None:
    loop, attachment = Loop(), Attachment()
    assert not attachment.takes_input
    assert attachment.write(b"nobody") == 0
    attachment.resize(10, 10)
    code = "import os; print(input(), *os.get_terminal_size(), flush=True)"
    spec = Spec(
        "a", (sys.executable, "-E", "-c", code), dict(os.environ), str(tmp_path), tty=True, stdin=False
    )
    child = spawn(spec)
    seen: list[bytes] = []
    streams = [
        Stream(loop, descriptor, lambda _text: None, attachment.feed) for descriptor in child.outputs.values()
    ]
    terminal = Terminal(loop, child.pid, child.outputs.values())
    attachment.began(terminal)
    tap = attachment.tap(lambda: None)
    assert attachment.takes_input
    attachment.resize(111, 22)
    assert attachment.write(b"hello\n") == 6
    while b"hello 111 22" not in b"".join(seen):
        loop.run_once()
        seen.append(tap.take())
    attachment.ended()
    assert not attachment.takes_input
    for stream in streams:
        stream.close()
    terminal.close()
    child.reap()
    loop.close()

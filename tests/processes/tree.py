"""A process with a family, as `tests.chaos.cases.Member` describes it in JSON: `tree.py COOKIE JSON`.

The cookie is only there to be seen in the command line, which forked processes keep and which goes along with every
program that is started here, so that a member of the family is known although it has no environment, no parent and no
session of ours any more.

What a member writes can be checked to the last byte: on each stream, a terminal's standard output alone, a line
`o begin PID` (`e` on standard error), numbered lines, and at the end, where it has the time for it, `o end PID COUNT
CRC` with the number of numbered lines and the CRC-32 of all of them.
"""

import contextlib
import json
import os
import signal
import subprocess
import sys
import time
import zlib
from typing import Any, NoReturn

COOKIE = sys.argv[1]
_WIDTH = 80
# A pipe takes this much in one piece, so that lines of several writers do not mix (PIPE_BUF).
_LINES_AT_ONCE = 4096 // _WIDTH
_ENDERS = (signal.SIGINT, signal.SIGTERM)
_POLITE_BREAK = 0.002


class Speaker:
    """Writes lines to a descriptor and keeps count of them."""

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        self._letter = "oe"[descriptor - 1]
        self._count = 0
        self._sum = 0

    def begin(self) -> None:
        self._write(f"{self._letter} begin {os.getpid()}\n".encode())

    def say(self, count: int) -> None:
        while count:
            lines = range(self._count, self._count + min(count, _LINES_AT_ONCE))
            text = "".join(
                f"{self._letter} {number:010d} ".ljust(_WIDTH - 1, "x") + "\n" for number in lines
            ).encode()
            self._write(text)
            self._sum = zlib.crc32(text, self._sum)
            self._count += len(lines)
            count -= len(lines)

    def end(self) -> None:
        self._write(f"{self._letter} end {os.getpid()} {self._count} {self._sum:08x}\n".encode())

    def _write(self, data: bytes) -> None:
        while data:
            data = data[os.write(self._descriptor, data) :]


def be(member: dict[str, Any]) -> NoReturn:
    """Live as the description says, and end the process with it."""
    streams = (1,) if os.isatty(1) else (1, 2)
    dress(member)
    speakers = [Speaker(number) for number in streams] if member.get("lines") is not None else []
    time.sleep(member.get("slow") or 0.0)
    for speaker in speakers:
        speaker.begin()
        speaker.say(member["lines"])
    for below in member.get("members", ()):
        start(below)
    for _ in range(member.get("storm") or 0):
        if os.fork() == 0:
            linger()
    announce(member)
    if member.get("stops"):
        os.kill(os.getpid(), signal.SIGSTOP)
    live(member, speakers)
    for speaker in speakers:
        speaker.end()
    os._exit(member.get("code") or 0)


def dress(member: dict[str, Any]) -> None:
    """Take the dispositions: polite members wait for a signal, so it is blocked; the others die of it, or ignore it."""
    for name in ("INT", "TERM", "HUP"):
        ignored = name in member.get("ignores", ())
        signal.signal(signal.Signals[f"SIG{name}"], signal.SIG_IGN if ignored else signal.SIG_DFL)
    how = signal.SIG_BLOCK if member.get("polite") else signal.SIG_UNBLOCK
    signal.pthread_sigmask(how, _ENDERS)
    if member.get("closes"):
        for number in (0, 1, 2):
            with contextlib.suppress(OSError):
                os.close(number)


def announce(member: dict[str, Any]) -> None:
    """Say that the family is there, on the standard output if there is one."""
    with contextlib.suppress(OSError):
        os.write(1, f"up {member['name']} {os.getpid()}\n".encode())


def live(member: dict[str, Any], speakers: list[Speaker]) -> None:
    """Stay until it is time, or until a polite member is asked to go."""
    over = None if member.get("after") is None else time.monotonic() + member["after"]
    while True:
        left = None if over is None else over - time.monotonic()
        if left is not None and left <= 0.0:
            return
        if member.get("floods"):
            for speaker in speakers:
                speaker.say(_LINES_AT_ONCE)
            left = _POLITE_BREAK
        if member.get("polite"):
            if wait_for_signal(left):
                return
        elif left is None:
            linger()
        else:
            time.sleep(min(left, _POLITE_BREAK) if member.get("floods") else left)


def wait_for_signal(seconds: float | None) -> bool:
    if seconds is None:
        signal.sigwait(_ENDERS)
        return True
    return signal.sigtimedwait(_ENDERS, seconds) is not None


def linger() -> NoReturn:
    while True:
        signal.pause()


def start(member: dict[str, Any]) -> None:
    """Start a member in the way that it wants; return when its process is there."""
    manner = member.get("manner")
    if manner in ("orphan", "daemon", "bare"):
        if os.fork() == 0:
            if manner != "orphan":
                os.setsid()
            if os.fork():
                os._exit(0)
            execute(member, {}) if manner == "bare" else be(member)
        os.wait()
    elif manner == "program":
        subprocess.Popen(words(member))
    elif os.fork() == 0:
        if manner == "session":
            os.setsid()
        be(member)


def execute(member: dict[str, Any], environment: dict[str, str]) -> NoReturn:
    os.execve(sys.executable, words(member), environment)  # noqa: S606 - no shell is wanted


def words(member: dict[str, Any]) -> list[str]:
    return [sys.executable, "-S", "-E", __file__, COOKIE, json.dumps(member)]


if __name__ == "__main__":
    be(json.loads(sys.argv[2]))

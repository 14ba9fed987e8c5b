"""Stands in for a node: does what its words say, in order, and says when it has.

ignore=INT,TERM     ignore these signals
polite=3            on SIGINT or SIGTERM say "bye" and exit with 3
leisurely=SECONDS   on SIGINT take so long, then say "bye" and exit with 0
child               start a stand-in that ignores nothing in the own group
child=ignore        ... that ignores INT and TERM
escape              start one in a session of its own (setsid); escape=ignore as above
daemon              start one as a daemon (double fork and setsid); daemon=ignore as above
anonymous           start a daemon without any environment
say=TEXT            write a line to standard output
complain=TEXT       write a line to standard error
partial=TEXT        write text without an end of line
bytes=N             write N bytes of numbered lines
show=NAME           write the value of an environment variable
disposition         write which signals are ignored and blocked
terminal            write whether standard input, output and error are terminals
exit=N, kill=NAME   end
linger              wait for ever, without being woken by anything periodic
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path


def write(text: str, descriptor: int = 1) -> None:
    data = memoryview(text.encode("utf-8", "surrogateescape"))
    while data:
        data = data[os.write(descriptor, data) :]


def numbers(words: str) -> list[signal.Signals]:
    return [signal.Signals[f"SIG{word}"] for word in words.split(",") if word]


def bid_farewell(status: int) -> None:
    def end(_number: int, _frame: object) -> None:
        write("bye\n")
        os._exit(status)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)


def take_leave(seconds: float) -> None:
    def end(_number: int, _frame: object) -> None:
        time.sleep(seconds)
        write("bye\n")
        os._exit(0)

    signal.signal(signal.SIGINT, end)


def start(kind: str, manner: str) -> None:
    """Start another stand-in and wait until it is there."""
    words = [
        sys.executable,
        "-S",
        "-E",
        __file__,
        *(["ignore=INT,TERM"] if manner == "ignore" else []),
        "say=up",
        "linger",
    ]
    script = {"child": words, "escape": words}.get(kind)
    read, told = os.pipe()
    if script:
        subprocess.Popen(script, stdout=told, start_new_session=kind == "escape")
    elif os.fork() == 0:
        os.setsid()
        environment: dict[str, str] | None = {} if kind == "anonymous" else None
        subprocess.Popen(words, stdout=told, env=environment)
        os._exit(0)
    else:
        os.wait()
    os.close(told)
    os.read(read, 3)


def linger(_value: str) -> None:
    while True:
        signal.pause()


def ignore(words: str) -> None:
    for number in numbers(words):
        signal.signal(number, signal.SIG_IGN)


def write_numbers(size: str) -> None:
    write("".join(f"{number:011d}\n" for number in range(int(size) // 12)))


def show_dispositions(_value: str) -> None:
    lines = Path("/proc/self/status").read_text().splitlines(keepends=True)
    write("".join(line for line in lines if line.startswith(("SigBlk", "SigIgn"))))


ACTIONS: dict[str, Callable[[str], object]] = {
    "ignore": ignore,
    "polite": lambda value: bid_farewell(int(value or 0)),
    "leisurely": lambda value: take_leave(float(value)),
    "child": lambda value: start("child", value),
    "escape": lambda value: start("escape", value),
    "daemon": lambda value: start("daemon", value),
    "anonymous": lambda value: start("anonymous", value),
    "say": lambda value: write(value + "\n"),
    "complain": lambda value: write(value + "\n", 2),
    "partial": write,
    "bytes": write_numbers,
    "show": lambda value: write(f"{value}={os.environ.get(value)}\n"),
    "disposition": show_dispositions,
    "terminal": lambda _value: write(" ".join(str(os.isatty(number)) for number in range(3)) + "\n"),
    "exit": lambda value: os._exit(int(value)),
    "kill": lambda value: os.kill(os.getpid(), signal.Signals[f"SIG{value}"]),
    "linger": linger,
}

signal.signal(signal.SIGINT, signal.SIG_DFL)  # no traceback
for given in sys.argv[1:]:
    name, _, argument = given.partition("=")
    ACTIONS[name](argument)

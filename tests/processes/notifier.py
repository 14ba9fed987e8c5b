"""Notifies as sd_notify(3) says: does what its words say, in order.

tell=TEXT           send TEXT to NOTIFY_SOCKET; | stands for a new line
child=TEXT          have a child send it, and wait for its end
barrier             wait until the other side has read everything
await=PATH          wait until there is such a file
every=SECONDS,N     say WATCHDOG=1 every so many seconds, N times; 0 is for ever
say=TEXT            write a line
show=NAME           write the value of an environment variable
crowd=N,TEXT        send TEXT N times, as fast as it goes
exit=N              end
linger              wait for ever
"""

import array
import os
import signal
import socket
import sys
import time
from collections.abc import Callable
from pathlib import Path


def tell(text: str, descriptors: tuple[int, ...] = ()) -> None:
    address = os.environ["NOTIFY_SOCKET"]
    ancillary = [(socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array("i", descriptors))] if descriptors else []
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as sender:
        data = text.replace("|", "\n").encode("utf-8", "surrogateescape")
        sender.sendmsg([data], ancillary, 0, f"\0{address[1:]}" if address[0] == "@" else address)


def by_child(text: str) -> None:
    if os.fork() == 0:
        tell(text)
        barrier("")
        os._exit(0)
    os.wait()


def barrier(_value: str) -> None:
    readable, writable = os.pipe()
    tell("BARRIER=1", (writable,))
    os.close(writable)
    os.read(readable, 1)
    os.close(readable)


def wait_for_file(path: str) -> None:
    while not Path(path).exists():
        time.sleep(0.01)


def every(words: str) -> None:
    seconds, count = words.split(",")
    told = 0
    while int(count) == 0 or told < int(count):
        tell("WATCHDOG=1")
        told += 1
        time.sleep(float(seconds))


def crowd(words: str) -> None:
    count, _, text = words.partition(",")
    for _ in range(int(count)):
        tell(text)


def say(text: str) -> None:
    os.write(1, f"{text}\n".encode())


def linger(_value: str) -> None:
    while True:
        signal.pause()


ACTIONS: dict[str, Callable[[str], object]] = {
    "tell": tell,
    "child": by_child,
    "barrier": barrier,
    "await": wait_for_file,
    "every": every,
    "crowd": crowd,
    "say": say,
    "show": lambda name: say(f"{name}={os.environ.get(name)}"),
    "exit": lambda value: os._exit(int(value)),
    "linger": linger,
}

signal.signal(signal.SIGINT, signal.SIG_DFL)  # no traceback
for given in sys.argv[1:]:
    name, _, argument = given.partition("=")
    ACTIONS[name](argument)

"""Multiplies against whoever tries to end it; everything ignores INT and TERM.

storm.py pairs=N      N pairs of processes, each in a session of its own; whoever outlives its partner makes a new one
storm.py comets=N     N processes that fork, leave their session, and go on in the child alone, for ever
"""

import os
import select
import signal
import socket
import sys
import time


def partner_of(connection: socket.socket) -> None:
    """Wait until the partner has gone, and make a new one."""
    while True:
        select.select([connection], [], [])
        connection.close()
        connection = with_partner()


def with_partner() -> socket.socket:
    ours, theirs = socket.socketpair()
    if os.fork() == 0:
        ours.close()
        os.setsid()
        partner_of(theirs)
    theirs.close()
    return ours


def comet() -> None:
    while True:
        if os.fork():
            os._exit(0)
        os.setsid()
        time.sleep(0.001)  # a comet that never rests leaves no processor to those who chase it


for number in (signal.SIGINT, signal.SIGTERM):
    signal.signal(number, signal.SIG_IGN)
# Nobody waits for those who end; the kernel shall not keep them.
signal.signal(signal.SIGCHLD, signal.SIG_IGN)
kind, count = sys.argv[1].split("=")
for _ in range(int(count)):
    if os.fork() == 0:
        os.setsid()
        if kind == "comets":
            comet()
        partner_of(with_partner())
sys.stdout.write("up\n")
sys.stdout.flush()
while True:
    signal.pause()

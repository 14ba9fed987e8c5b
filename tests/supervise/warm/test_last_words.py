"""What a fork server says before it ends is heard, whoever notices the end first."""

from __future__ import annotations

import _socket
import os
import sys
from contextlib import closing
from typing import Any

from orchestra.supervise.keeping.kin import Kin
from orchestra.supervise.loop import Loop
from orchestra.supervise.process.spawn import spawn
from orchestra.supervise.process.spec import Spec
from orchestra.supervise.warm.launching import Launched
from orchestra.supervise.warm.server import Server

SPEAKING = """
import socket
socket.socket(fileno=0).send(b'{"unusable": "not today"}')
"""


def spoken() -> Launched:
    """Return a server that has said its last words and has ended."""
    ours, theirs = _socket.socketpair(_socket.AF_UNIX, _socket.SOCK_SEQPACKET)
    ours.setblocking(False)
    command = (sys.executable, "-S", "-c", SPEAKING)
    child = spawn(Spec("server", command, dict(os.environ), None, tty=False, stdin=False), theirs.fileno())
    theirs.close()
    os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOWAIT)
    return Launched(child, ours, {})


def test_a_request_that_nobody_takes_leaves_its_last_words_to_be_heard() -> None:
    heard: list[dict[str, Any]] = []
    lost: list[str] = []
    with closing(Loop()) as loop:
        server = Server(loop, Kin("no run"), spoken(), lambda _: None, (heard.append, lost.append))
        server.tell({"id": 1})
        while server.alive:
            loop.run_once()
    assert heard == [{"unusable": "not today"}]
    assert len(lost) == 1

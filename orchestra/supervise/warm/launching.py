"""Starts the program of the fork server: as early as possible, since its imports take as long as all of ours."""

from __future__ import annotations

import _socket
import os
import sys
from typing import TYPE_CHECKING, NamedTuple

from orchestra.supervise.environment import node_environment
from orchestra.supervise.keeping.marks import PROCESS
from orchestra.supervise.process.spawn import spawn
from orchestra.supervise.process.spec import Spec

if TYPE_CHECKING:
    from orchestra.supervise.environment import Host
    from orchestra.supervise.process.child import Child

# By its file: with `-m`, or another option, nodes would have other flags than those that are started cold.
PROGRAM = os.path.join(os.path.dirname(__file__), "..", "..", "ros", "warm", "__main__.py")  # noqa: PTH118, PTH120 - pathlib is slow


class Launched(NamedTuple):
    """The process of a server, our end of the socket to it, and the variables that it has."""

    child: Child
    connection: _socket.socket
    environment: dict[str, str]


def environment_of(run_id: str, host: Host) -> dict[str, str]:
    """Return the environment of a server: what is the same for all nodes of a run."""
    environment = node_environment(os.environ, host, {}, log_folder="", colour=False, marks=(run_id, ""))
    del environment[PROCESS]
    return environment


def launch(environment: dict[str, str]) -> Launched:
    """Start a server. Raises `OSError`."""
    ours, theirs = _socket.socketpair(_socket.AF_UNIX, _socket.SOCK_SEQPACKET)
    ours.setblocking(False)
    command = (sys.executable, os.path.abspath(PROGRAM), str(os.getpid()))  # noqa: PTH100 - as above
    spec = Spec("fork server", command, environment, None, tty=False, stdin=False)
    try:
        return Launched(spawn(spec, stdin=theirs.fileno()), ours, environment)
    except OSError:
        ours.close()
        raise
    finally:
        theirs.close()

"""The resolver process: `prepare` with everything heavy and all user code lives and dies there.

It hands over one document, behind a line of JSON `{"size": BYTES, "stays": BOOL, "settled": BOOL}`, and ends; where it
stays it answers what it is asked (`serving`) until the supervisor closes the connection, or, where it is settled, does
something more that is nothing to the run.
"""

from __future__ import annotations

import io
import os
import signal
import sys

from orchestra.supervise.keeping import kernel
from orchestra.supervise.keeping.signals import reset_signals, unblock_signals
from orchestra.supervise.keeping.standard_streams import flush

TYPE_CHECKING = False  # `typing` costs more than this module, which the keeper carries
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import BinaryIO, TypeAlias

    from orchestra.supervise.keeping.stacks import Stacks
    from orchestra.supervise.resolver.serving import Answer, Settled

    Prepare: TypeAlias = Callable[[BinaryIO], int | Answer | Settled]

BUG = 3


class Resolver:
    """A running resolver: its pid and the descriptor, of a socket, to talk with it."""

    __slots__ = ("descriptor", "pid")

    def __init__(self, pid: int, descriptor: int) -> None:
        self.pid = pid
        self.descriptor = descriptor


def fork_resolver(prepare: Prepare, stacks: Stacks) -> Resolver:
    """Run `prepare` in a child with default signals and a session of its own; it dies with its parent.

    On SIGQUIT it writes where its code is, and goes on.
    """
    ours, theirs = _connection()
    parent = os.getpid()
    pid = os.fork()
    if pid:
        os.close(theirs)
        os.set_blocking(ours, False)
        return Resolver(pid, ours)
    status = BUG
    try:
        os.close(ours)
        kernel.die_with_parent(signal.SIGKILL, parent)
        kernel.set_name("orc-resolver")
        os.setsid()
        reset_signals(unblock=False)
        stacks.show_on_request(chain=False)
        unblock_signals()
        status = _prepare(prepare, theirs)
    finally:
        os._exit(status)


def _connection() -> tuple[int, int]:
    import _socket  # noqa: PLC0415 - `socket` itself costs more than this module, and two descriptors are all we want

    ours, theirs = _socket.socketpair(_socket.AF_UNIX, _socket.SOCK_STREAM)
    return ours.detach(), theirs.detach()


def _prepare(prepare: Prepare, descriptor: int) -> int:
    # Until the plan is there all that is made stays: to walk through it again and again takes a tenth of the time.
    import gc  # noqa: PLC0415 - the keeper has no use for it

    gc.disable()
    try:
        # Held back until it is complete: a resolver that fails half-way has handed over nothing.
        document = io.BytesIO()
        result = prepare(document)
        if result == 0 or not isinstance(result, int):
            # Only now, and only here: neither keeper nor supervisor needs it.
            from orchestra.supervise.resolver.serving import Settled, hand_over, serve  # noqa: PLC0415

            settled = isinstance(result, Settled)
            flush()
            hand_over(document.getbuffer(), descriptor, stays=not isinstance(result, int), settled=settled)
            if isinstance(result, Settled):
                result.afterwards()
                result = 0
            elif not isinstance(result, int):
                gc.enable()
                result = serve(result, descriptor)
        status = result
    except SystemExit as error:
        status = _status(error)
    except BaseException:  # noqa: BLE001 - the boundary of this process: nothing may run on into the supervisor's code
        sys.excepthook(*sys.exc_info())
        status = BUG
    flush()
    return status


def _status(error: SystemExit) -> int:
    """Do as the interpreter would at its end."""
    if error.code is None or isinstance(error.code, int):
        return error.code or 0
    sys.stderr.write(f"{error.code}\n")
    return 1

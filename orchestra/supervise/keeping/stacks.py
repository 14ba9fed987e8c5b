"""Where our own processes are in their code, written at once by a handler that needs no interpreter (faulthandler).

One pipe is shared by keeper, supervisor and resolver: made before the first fork, written without blocking, and read by
the supervisor, or by the keeper where the supervisor is stuck.
"""

from __future__ import annotations

import faulthandler
import os
import select
import signal

from orchestra.supervise.keeping import kernel

# A handler writes line by line; when nothing has come for so long, that was all. In seconds.
QUIET = 0.1
_READ_SIZE = 65536


class Stacks:
    """The pipe. What does not fit into it is lost; `descriptor` is where it is read."""

    __slots__ = ("_writable", "descriptor")

    def __init__(self) -> None:
        self.descriptor, self._writable = os.pipe()
        os.set_blocking(self.descriptor, False)
        os.set_blocking(self._writable, False)

    def show_on_request(self, *, chain: bool) -> None:
        """From now on write the stacks of this process on SIGQUIT; `chain` calls the handler that was there too."""
        faulthandler.register(signal.SIGQUIT, self._writable, all_threads=True, chain=chain)
        kernel.handle_signals_on_the_ordinary_stack()

    def show(self, name: str) -> None:
        """Write the stacks of this process now, under its name."""
        self.title(name, os.getpid())
        faulthandler.dump_traceback(self._writable, all_threads=True)

    def title(self, name: str, pid: int) -> None:
        """Write whose stacks follow."""
        try:
            os.write(self._writable, f"{name} (pid {pid}):\n".encode())
        except BlockingIOError:
            return  # the pipe is full of stacks that nobody has read

    def read(self, patience: float = 0.0) -> str:
        """Return what has been written; with patience, wait so many seconds for the first of it, and for its end."""
        poll = select.poll()
        poll.register(self.descriptor, select.POLLIN)
        content = bytearray()
        while poll.poll(patience * 1000):
            try:
                content += os.read(self.descriptor, _READ_SIZE)
            except BlockingIOError:
                break  # the other reader was quicker
            patience = min(patience, QUIET)
        return content.decode("utf-8", "replace")

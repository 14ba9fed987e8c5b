"""One process of the observer: started, told things, heard, and ended."""

from __future__ import annotations

import json
import os
import signal
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.supervise.graph import dialogue
from orchestra.supervise.keeping.kin import send_to_groups
from orchestra.supervise.output.outbox import Outbox
from orchestra.supervise.output.stream import Stream, as_text
from orchestra.supervise.process.ending import Ending
from orchestra.supervise.process.spawn import spawn

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.supervise.keeping.kin import Kin
    from orchestra.supervise.loop import Loop
    from orchestra.supervise.process.child import Child
    from orchestra.supervise.process.spec import Spec

    # Who hears a message of it, and why it is lost.
    Heard: TypeAlias = Callable[["Observer", dict[str, Any]], None]
    Lost: TypeAlias = Callable[["Observer", str], None]

# A participant that leaves without saying so stays in the graphs of others for 20 s, so it is asked first.
_LEAVE_WITHIN = 1.0
# In characters: no message is as long as this.
_LONGEST = 65536
# In characters: so much of what nobody understands is shown.
_SHOWN = 80


class Observer:
    """A running observer. `lost` is called once, where it ends, or is of no use, without having been asked to leave.

    It is `hopeless` where it ended by itself before it came into the graph: the next one would not come either.
    """

    def __init__(
        self, loop: Loop, kin: Kin, spec: Spec, said: Callable[[str], None], ears: tuple[Heard, Lost]
    ) -> None:
        self._loop = loop
        self._kin = kin
        self._heard, self._lost = ears
        self._partial = ""
        self._here = False
        self._is_deaf = False
        self.hopeless = False
        inner, outer = os.pipe()
        try:
            self._child: Child | None = spawn(spec, stdin=inner)
        except OSError:
            os.close(outer)
            raise
        finally:
            os.close(inner)
        os.set_blocking(outer, False)
        self._outbox = Outbox(loop, outer, self._refused)
        kin.add(self._child.pid, None)
        outputs = self._child.outputs
        self._streams = [
            Stream(loop, outputs["stdout"], as_text(self._read)),
            Stream(loop, outputs["stderr"], as_text(said)),
        ]
        loop.on_readable(self._child.pidfd, self._ended)

    @property
    def alive(self) -> bool:
        """Whether its process has not been reaped."""
        return self._child is not None

    @property
    def leaving(self) -> bool:
        """Whether it has been asked to end, or is lost."""
        return not self._outbox.open and not self._is_deaf

    def tell(self, message: Mapping[str, Any]) -> None:
        """Send it a message; nothing where it is leaving."""
        self._outbox.send((json.dumps(message) + "\n").encode())

    def leave(self) -> None:
        """Ask it to end; it is killed where it does not, and at once where it has not come into the graph yet."""
        if not self._here:
            self.kill()
        elif self._outbox.open:
            self._outbox.close()
            self._loop.call_later(_LEAVE_WITHIN, self.kill)

    def kill(self) -> None:
        """End it now; it is not lost by that."""
        self._outbox.close()
        if self._child:
            send_to_groups([self._child.pid], signal.SIGKILL)

    def _refused(self, _error: OSError) -> None:
        """Nobody takes orders any more: it has ended, or ends now. It is lost when it is known how."""
        self._is_deaf = True
        self.kill()

    def _lose(self, reason: str) -> None:
        if not self.leaving:
            self._is_deaf = False
            self.kill()
            self._lost(self, reason)

    def _read(self, text: str) -> None:
        *lines, self._partial = (self._partial + text).split("\n")
        for line in lines:
            message = dialogue.heard(line)
            if message is None:
                self._lose(f"said what nobody understands: {line[:_SHOWN]!r}")
            if self.leaving:
                return
            if message is not None:
                self._here = True
                self._heard(self, message)
        if len(self._partial) > _LONGEST:
            self._lose(f"said what nobody understands: {self._partial[:_SHOWN]!r}")

    def _ended(self) -> None:
        child = self._child
        ended = child.ended() if child else None
        if child is None or ended is None:
            return
        self._loop.forget(child.pidfd)
        for stream in self._streams:
            stream.close()
        self._kin.remove(child.pid)
        child.reap()
        self._child = None
        code, _signal = ended
        self.hopeless = code is not None and not self._here
        self._lose(f"ended ({Ending(*ended)})")

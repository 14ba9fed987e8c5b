"""Talks with the observer: a process of ours with rclpy, which looks into the ROS graph while something is awaited.

One JSON object per line. To it: `{"watch": ID, "topic": NAME}`, `{"forget": ID}`. From it: `{"seen": ID}`,
`{"impossible": ID, "reason": TEXT}`. It ends when its standard input does.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.supervise.ending import Ending
from orchestra.supervise.environment import middleware
from orchestra.supervise.kin import send_to_groups
from orchestra.supervise.marks import PROCESS
from orchestra.supervise.spawn import Child, spawn
from orchestra.supervise.spec import Spec
from orchestra.supervise.stream import Stream

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from orchestra.probes.protocol import Request
    from orchestra.supervise.kin import Kin
    from orchestra.supervise.loop import Loop

# By its file and with `-P`: with `-m`, modules in the user's working directory would come before all others.
_COMMAND = (sys.executable, "-P", str(Path(__file__).parents[1] / "ros" / "observer" / "__main__.py"))
# A participant that leaves without saying so stays in the graphs of others for 20 s, so it is asked first.
_LEAVE_WITHIN = 1.0


class Observer:
    """One running observer. `answers` maps what is watched to whom is told: None for seen, else why it cannot be."""

    def __init__(
        self, loop: Loop, kin: Kin, spec: Spec, said: Callable[[str], None], died: Callable[[str], None]
    ) -> None:
        self._loop = loop
        self._kin = kin
        self._died = died
        self.answers: dict[str, Callable[[str | None], None]] = {}
        self._partial = ""
        inner, outer = os.pipe()
        try:
            self._child: Child | None = spawn(spec, stdin=inner)
        except OSError:
            os.close(outer)
            raise
        finally:
            os.close(inner)
        os.set_blocking(outer, False)
        self._stdin: int | None = outer
        kin.add(self._child.pid, None)
        outputs = self._child.outputs
        self._streams = [Stream(loop, outputs["stdout"], self._heard), Stream(loop, outputs["stderr"], said)]
        loop.on_readable(self._child.pidfd, self._ended)

    @property
    def alive(self) -> bool:
        """Whether its process has not been reaped."""
        return self._child is not None

    @property
    def leaving(self) -> bool:
        """Whether it has been asked to end."""
        return self._stdin is None

    def watch(self, name: str, request: Request, answer: Callable[[str | None], None]) -> None:
        """Look out for something."""
        self.answers[name] = answer
        self._tell({"watch": name, "topic": request.topic})

    def forget(self, name: str) -> None:
        """Look out no longer."""
        if self.answers.pop(name, None) and not self.leaving:
            self._tell({"forget": name})

    def leave(self) -> None:
        """Ask it to end; it is killed where it does not."""
        if self._stdin is not None:
            os.close(self._stdin)
            self._stdin = None
            self._loop.call_later(_LEAVE_WITHIN, self.kill)

    def kill(self) -> None:
        """End it now."""
        if self._child:
            send_to_groups([self._child.pid], signal.SIGKILL)

    def _tell(self, message: dict[str, str]) -> None:
        if self._stdin is None:
            return
        try:
            os.write(self._stdin, (json.dumps(message) + "\n").encode())
        except OSError as error:  # it is dead, which its pidfd tells too, or it does not read at all
            os.close(self._stdin)
            self._stdin = None
            self._died(f"the observer takes no requests: {error.strerror}")

    def _heard(self, text: str) -> None:
        *lines, self._partial = (self._partial + text).split("\n")
        for line in lines:
            self._answer(json.loads(line))

    def _answer(self, message: dict[str, str]) -> None:
        name = message.get("seen") or message.get("impossible")
        answer = self.answers.pop(name, None) if name else None
        if answer:
            answer(message.get("reason"))

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
        if self._stdin is not None:
            os.close(self._stdin)
            self._stdin = None
            self._died(f"the observer, which looks into the ROS graph, ended ({Ending(*ended)})")


class Observers:
    """One observer for each way to reach the middleware: nodes in another domain need one of their own."""

    def __init__(
        self, loop: Loop, kin: Kin, said: Callable[[str], None], died: Callable[[str], None]
    ) -> None:
        self._loop = loop
        self._kin = kin
        self._said = said
        self._died = died
        self._running: dict[str, Observer] = {}
        self._former: list[Observer] = []

    def prepare(self, environment: Mapping[str, str]) -> Observer:
        """Start the observer for an environment unless it runs: importing rclpy takes as long as a node's start."""
        key = json.dumps(middleware(environment), sort_keys=True)
        observer = self._running.get(key)
        if observer is None or observer.leaving:
            if observer:
                self._former.append(observer)
            variables = {name: value for name, value in environment.items() if name != PROCESS}
            spec = Spec("observer", (*_COMMAND, str(os.getpid())), variables, None, tty=False, stdin=False)
            observer = Observer(self._loop, self._kin, spec, self._said, self._died)
            self._running[key] = observer
        return observer

    def watch(
        self,
        name: str,
        request: Request,
        environment: Mapping[str, str],
        answer: Callable[[str | None], None],
    ) -> None:
        """Look out for something in the graph that processes with this environment see."""
        try:
            observer = self.prepare(environment)
        except OSError as error:
            answer(f"the observer could not be started: {error}")
        else:
            observer.watch(name, request, answer)

    def forget(self, name: str) -> None:
        """Look out no longer."""
        for observer in self._running.values():
            observer.forget(name)

    def leave(self) -> None:
        """Let all of them end: nothing is awaited, and nothing will be."""
        for observer in self._running.values():
            observer.leave()

    @property
    def alive(self) -> Sequence[Observer]:
        """Those whose process has not been reaped."""
        return [observer for observer in (*self._running.values(), *self._former) if observer.alive]

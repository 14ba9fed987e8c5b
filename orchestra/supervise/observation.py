"""Talks with the observer: a process of ours with rclpy, which looks into the ROS graph, and asks nodes, for us.

One JSON object per line. Orders to it, each with an id, are `{"id": ID, "do": NAME, ...}`; `{"forget": ID}` takes one
back. What it says to an order is `{"id": ID, "say": WORD, ...}`:

    watch          topic                 done: the first message on it came
    transitions    node                  watching; then moved, again and again: transition, start_state, goal_state
    change_state   node, transition      asking: the service is there; done: state, as it is now
    load           container, component  asking: the service is there; done: node, unique_id

and `impossible` with a `reason` where it will not be done. It ends when its standard input does.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.supervise.ending import Ending
from orchestra.supervise.environment import middleware
from orchestra.supervise.kin import send_to_groups
from orchestra.supervise.marks import PROCESS
from orchestra.supervise.outbox import Outbox
from orchestra.supervise.spawn import Child, spawn
from orchestra.supervise.spec import Spec
from orchestra.supervise.stream import Stream

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from orchestra.probes.protocol import Request
    from orchestra.supervise.kin import Kin
    from orchestra.supervise.loop import Loop

    # Who hears what the observer says to one order.
    Heard: TypeAlias = Callable[[dict[str, Any]], None]

# By its file and with `-P`: with `-m`, modules in the user's working directory would come before all others.
_COMMAND = (sys.executable, "-P", str(Path(__file__).parents[1] / "ros" / "observer" / "__main__.py"))
# A participant that leaves without saying so stays in the graphs of others for 20 s, so it is asked first.
_LEAVE_WITHIN = 1.0


class Observer:
    """One running observer. `orders` maps the ids of open orders to who hears what is said to them."""

    def __init__(
        self, loop: Loop, kin: Kin, spec: Spec, said: Callable[[str], None], died: Callable[[str], None]
    ) -> None:
        self._loop = loop
        self._kin = kin
        self._died = died
        self.orders: dict[str, Heard] = {}
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
        self._outbox = Outbox(loop, outer, self._broken)
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
        return not self._outbox.open

    def order(self, name: str, order: Mapping[str, Any], heard: Heard) -> None:
        """Have something done; `heard` gets everything that is said to it."""
        self.orders[name] = heard
        self._tell({"id": name, **order})

    def forget(self, name: str) -> None:
        """Take an order back."""
        if self.orders.pop(name, None) and not self.leaving:
            self._tell({"forget": name})

    def leave(self) -> None:
        """Ask it to end; it is killed where it does not."""
        if self._outbox.open:
            self._outbox.close()
            self._loop.call_later(_LEAVE_WITHIN, self.kill)

    def kill(self) -> None:
        """End it now."""
        if self._child:
            send_to_groups([self._child.pid], signal.SIGKILL)

    def _tell(self, message: Mapping[str, Any]) -> None:
        self._outbox.send((json.dumps(message) + "\n").encode())

    def _broken(self, error: OSError) -> None:
        """It is dead, which its pidfd tells too, or has closed its input."""
        self._outbox.close()
        self._died(f"the observer takes no requests: {error.strerror}")

    def _heard(self, text: str) -> None:
        *lines, self._partial = (self._partial + text).split("\n")
        for line in lines:
            self._hear(json.loads(line))

    def _hear(self, message: dict[str, Any]) -> None:
        name = message["id"]
        final = message["say"] in ("done", "impossible")
        heard = self.orders.pop(name, None) if final else self.orders.get(name)
        if heard:
            heard(message)

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
        if self._outbox.open:
            self._outbox.close()
            self._died(f"the observer, which looks into the ROS graph, ended ({Ending(*ended)})")


class Observers:
    """One observer for each way to reach the middleware: nodes in another domain need one of their own.

    `on_death` hears why one of them has ended that should not have.
    """

    def __init__(self, loop: Loop, kin: Kin, said: Callable[[str], None]) -> None:
        self.on_death: Callable[[str], None] = lambda _reason: None
        self._loop = loop
        self._kin = kin
        self._said = said
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
            observer = Observer(self._loop, self._kin, spec, self._said, self.on_death)
            self._running[key] = observer
        return observer

    def watch(
        self,
        name: str,
        request: Request,
        environment: Mapping[str, str],
        answer: Callable[[str | None], None],
    ) -> None:
        """Look out for something in the graph; `answer` gets None where it came, else why it cannot."""
        self.order(name, request.order, environment, lambda message: answer(message.get("reason")))

    def order(
        self, name: str, order: Mapping[str, Any], environment: Mapping[str, str], heard: Heard
    ) -> None:
        """Have something done in the graph that processes with this environment see."""
        try:
            observer = self.prepare(environment)
        except OSError as error:
            heard({"say": "impossible", "reason": f"the observer could not be started: {error}"})
        else:
            observer.order(name, order, heard)

    def forget(self, name: str) -> None:
        """Take an order back."""
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

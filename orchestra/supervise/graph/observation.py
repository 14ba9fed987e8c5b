"""Talks with the observer: a process of ours with rclpy, which looks into the ROS graph, and asks nodes, for us.

One JSON object per line, both ways. Orders to it, each with an id of its own, are `{"id": ID, "do": NAME, ...}`. What
it says to an order is `{"id": ID, "say": WORD, ...}`; `done` and `impossible`, which has a `reason`, are the last word.

    do             with                       says
    watch          fact, and what it is of    done: it holds
    rate           topic, window              rate: rate; once per window, until it is forgotten
    transitions    node                       watching; then moved, again and again: transition, start_state, goal_state
    stay           node                       nothing: the observer stays, and knows the graph, until it is forgotten
    change_state   node, transition           asking: the services are there; done: state, as it is now
    load           container, component       asking: the service is there; done: node, unique_id

Facts, with full names: `node` (name) is in the graph; `topic` (name) has a publisher; `message` (topic): one has come;
`service` and `action` (name) have a server; `parameter` (node, name and perhaps value: text, number, boolean, list);
`lifecycle` (node, state: its label) is or was in the state; `tf` (parent, child) are connected by transforms.

`rate` is in messages a second over `window` seconds, 0.0 where nobody publishes. Nothing is said of a window in which
other publishers came or went, and the first one begins with the first message: no rate means that nothing is known.

`change_state` takes the id of a transition (lifecycle_msgs/msg/Transition); with `only_in`, a state's label, the node
is left alone where it is in another state. With `again` the order may have been carried out before, by an observer
that died: a node that is where the transition leads is left alone.

`{"forget": ID}` takes an order back: nothing is said to it any more. `{"ping": N}` is answered with `{"pong": N}`, by
the thread that does the work; with `{"pong": 0}` it says that it is in the graph. It ends when its standard input does.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.supervise.environment import middleware
from orchestra.supervise.keeping.marks import PROCESS
from orchestra.supervise.process.spec import Spec

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from orchestra.probes.protocol import Request
    from orchestra.supervise.graph import observer
    from orchestra.supervise.graph.lookout import Heard, Lookout, Patience
    from orchestra.supervise.graph.observer import Observer
    from orchestra.supervise.keeping.kin import Kin
    from orchestra.supervise.loop import Loop

# By its file and with `-P`: with `-m`, modules in the user's working directory would come before all others.
COMMAND = (sys.executable, "-P", str(Path(__file__).parents[2] / "ros" / "observer" / "__main__.py"))


class Observers:
    """One observer for each way to reach the middleware: nodes in another domain need one of their own.

    `said` gets what users should know of them, their standard error included.
    """

    def __init__(
        self,
        loop: Loop,
        kin: Kin,
        said: Callable[[str], None],
        *,
        command: Sequence[str] = COMMAND,
        patience: Patience | None = None,
    ) -> None:
        self._loop = loop
        self._kin = kin
        self._said = said
        self._command = tuple(command)
        self._patience = patience
        self._lookouts: dict[str, Lookout] = {}

    def prepare(self, environment: Mapping[str, str]) -> None:
        """Start the observer for an environment unless it runs: importing rclpy takes as long as a node's start.

        Raises `OSError`.
        """
        self._lookout(environment).prepare()

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
        self._lookout(environment).order(name, order, heard)

    def forget(self, name: str) -> None:
        """Take an order back."""
        for lookout in self._lookouts.values():
            lookout.forget(name)

    def drop(self) -> None:
        """Look out for nothing any more: the run ends. What nodes are asked goes on."""
        for lookout in self._lookouts.values():
            lookout.drop()

    def relieve(self) -> None:
        """Let those end that have nothing to do, since nothing will be soon."""
        for lookout in self._lookouts.values():
            lookout.relieve()

    def leave(self) -> None:
        """Let all of them end, whatever they are about."""
        for lookout in self._lookouts.values():
            lookout.leave()

    @property
    def alive(self) -> Sequence[Observer]:
        """Those whose process has not been reaped."""
        return [one for lookout in self._lookouts.values() for one in lookout.alive]

    def _lookout(self, environment: Mapping[str, str]) -> Lookout:
        key = json.dumps(middleware(environment), sort_keys=True)
        if key not in self._lookouts:
            # Here, because few runs need an observer, and none for its first process to begin.
            from orchestra.supervise.graph.lookout import Lookout, Patience  # noqa: PLC0415
            from orchestra.supervise.graph.observer import Observer  # noqa: PLC0415

            variables = {name: value for name, value in environment.items() if name != PROCESS}
            command = (*self._command, str(os.getpid()))
            spec = Spec("observer", command, variables, None, tty=False, stdin=False)

            def start(ears: tuple[observer.Heard, observer.Lost]) -> Observer:
                return Observer(self._loop, self._kin, spec, self._said, ears)

            self._lookouts[key] = Lookout(self._loop, start, self._said, self._patience or Patience())
        return self._lookouts[key]

"""What a running plan has to do with single ROS nodes: lifecycle nodes and components, through the observer."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from orchestra.logs.names import shown
from orchestra.supervise.environment import Later
from orchestra.supervise.graph.deactivation import Deactivation
from orchestra.supervise.graph.lifecycle import TO_ACTIVE, LifecycleNodes, Node
from orchestra.supervise.graph.loading import Loading
from orchestra.supervise.graph.orders import Limits, Orders

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from orchestra.plan.model import Component, Process
    from orchestra.plan.reactions import Trigger
    from orchestra.supervise.reactions.happening import Happening
    from orchestra.supervise.surroundings import Surroundings


class Nodes:
    """Tells lifecycle nodes and containers what they are to do, as their processes come and go.

    `happened` hears of transitions, `went_wrong` what was not done, in words, `settled` that an order is over.
    """

    def __init__(
        self,
        surroundings: Surroundings,
        happened: Callable[[Happening], None],
        went_wrong: Callable[[str], None],
        settled: Callable[[], None],
    ) -> None:
        self._around = surroundings
        limits = Limits(surroundings.options.service_timeout, surroundings.options.answer_timeout)
        orders = Orders(surroundings.observers, surroundings.loop, limits, settled)
        self._lifecycle = LifecycleNodes(orders, surroundings, happened, self._entered, went_wrong)
        self._deactivation = Deactivation(surroundings, settled)
        self._loading = Loading(orders, surroundings, self._loaded, went_wrong)
        self._processes: dict[str, Process] = {}
        self._pids: dict[str, int] = {}
        self._watched: set[str | None] = set()
        self._managed: set[str] = set()

    @property
    def pending(self) -> bool:
        """Whether the answer of a node is awaited."""
        return self._lifecycle.moving or self._loading.busy

    def concerns(self, process: Process) -> bool:
        """Tell whether the observer will be needed when a process runs."""
        return (
            process.lifecycle == "active"
            or self._is_watched(process.id, process.kind)
            or self._loading.awaits(process.id)
        )

    def add(
        self, processes: Iterable[Process], components: Iterable[Component], triggers: Iterable[Trigger]
    ) -> None:
        """Take up what a plan, or a fragment of one, says; before any of its processes starts."""
        self._processes.update({process.id: process for process in processes})
        self._watched.update(trigger.on.target for trigger in triggers if trigger.on.event == "state_changed")
        self._loading.add(components, self._around.environment(None))

    def watch(self) -> None:
        """Listen to processes that ran before somebody wanted to hear of them."""
        for name in self._pids:
            if self._is_watched(name, self._processes[name].kind):
                self._lifecycle.watch(name)

    def started(self, name: str, pid: int) -> None:
        """A process runs."""
        process = self._processes[name]
        self._pids[name] = pid
        environment = Later(partial(self._around.environment, process))
        node = Node(name, full_name(process), environment, pid)
        self._lifecycle.appeared(node, watched=self._is_watched(name, process.kind))
        if process.lifecycle == "active":
            self._keep_active(name)
        if self._loading.awaits(name):
            self._loading.started(name, environment)

    def ended(self, name: str, reason: str) -> None:
        """One run of a process is over."""
        self._pids.pop(name, None)
        reason = f"{shown(name)} has ended ({reason})"
        self._lifecycle.disappeared(name, reason)
        self._deactivation.ended(name)
        for component in self._loading.ended(name):
            self._lifecycle.disappeared(component.id, reason)
            self._deactivation.gone(component.id)

    def never(self, name: str, reason: str) -> None:
        """A process will not start (again) by itself."""
        reason = f"{shown(name)} {reason}"
        self._lifecycle.never({name}, reason)
        self._loading.never(name, reason)

    def load(self, component: str) -> None:
        """Load a component."""
        self._loading.load(component)

    def change_state(self, names: Iterable[str], transitions: tuple[int, ...]) -> None:
        """Take nodes through transitions."""
        for name in names:
            self._lifecycle.change(name, transitions)

    def quiesce(self, process: str, done: Callable[[], None]) -> None:
        """Deactivate the nodes in a process that are kept active, before it is ended.

        `done` is called once, whatever comes of it: at once where there is nothing to do, never after its end.
        """
        names = [process, *self._loading.loaded_into(process)]
        for name in names:
            self._lifecycle.release(name)
        self._deactivation.begin(process, names, done)

    def stop(self) -> None:
        """The run ends: nodes are only asked to deactivate, each before its process is ended."""
        self._lifecycle.stop()
        self._loading.stop()

    def _is_watched(self, name: str, kind: str) -> bool:
        return name in self._watched or (None in self._watched and kind == "lifecycle_node")

    def _loaded(self, component: Component, node: str, environment: Mapping[str, str]) -> None:
        pid = self._pids.get(component.process) if component.process is not None else None
        managed = component.lifecycle == "active"
        watched = self._is_watched(component.id, "lifecycle_node" if managed else "component")
        self._lifecycle.appeared(Node(component.id, node, environment, pid), watched=watched)
        if managed:
            self._keep_active(component.id)

    def _keep_active(self, name: str) -> None:
        self._managed.add(name)
        self._lifecycle.change(name, TO_ACTIVE)

    def _entered(self, node: Node, state: str) -> None:
        if node.id in self._managed:
            self._deactivation.entered(node, state)


def full_name(process: Process) -> str:
    """Return the full name of the node of a process; one that has no name is called as its process."""
    if process.name is None:
        return process.id
    return f"{(process.namespace or '').rstrip('/')}/{process.name}"

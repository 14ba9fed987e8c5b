"""Loads components into containers: one request after another for each container, in the order of the plan.

A container that starts again has lost what was loaded, so all of it is loaded again. Containers that are no process of
the plan are expected to be there.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.logs.names import shown
from orchestra.plan.model import Component
from orchestra.supervise.graph.orders import Order

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.supervise.graph.orders import Orders, Refusal
    from orchestra.supervise.surroundings import Surroundings


@dataclass(slots=True)
class _Container:
    """What belongs into a container, in order; what is still to be loaded, is being loaded, and is there.

    `environment` is None while it does not run. `over` says why it never will again.
    """

    wanted: dict[str, Component] = field(default_factory=dict)
    todo: dict[str, Component] = field(default_factory=dict)
    current: Component | None = None
    there: dict[str, Component] = field(default_factory=dict)
    environment: Mapping[str, str] | None = None
    over: str | None = None


class Loading:
    """Keeps containers filled.

    `loaded` hears of a component, the full name of its node and the environment of its container; `went_wrong` of those
    that could not be loaded, in words.
    """

    def __init__(
        self,
        orders: Orders,
        surroundings: Surroundings,
        loaded: Callable[[Component, str, Mapping[str, str]], None],
        went_wrong: Callable[[str], None],
    ) -> None:
        self._orders = orders
        self._around = surroundings
        self._loaded = loaded
        self._went_wrong = went_wrong
        self._components: dict[str, Component] = {}
        self._containers: dict[str, _Container] = {}
        self._filled: dict[str, _Container] = {}  # those of them into which something was to be loaded
        self._stopped = False

    @property
    def busy(self) -> bool:
        """Whether the observer is needed."""
        return any(item.current for item in self._filled.values())

    def awaits(self, process: str) -> bool:
        """Tell whether something is to be loaded into a process."""
        container = self._containers.get(process)
        return container is not None and bool(container.wanted)

    def loaded_into(self, process: str) -> list[str]:
        """Return the ids of the components that are in a process."""
        container = self._containers.get(process)
        return [] if container is None else [*container.there]

    def add(self, components: Iterable[Component], outside: Mapping[str, str]) -> None:
        """Take up more components; `outside` is the environment that sees containers which are none of the plan."""
        for component in components:
            self._components[component.id] = component
            if component.process is None:
                self._container(_key(component)).environment = outside
        for component in components:
            if component.condition == "started":
                self.load(component.id)

    def load(self, name: str) -> None:
        """Load a component as soon as its container takes orders; it is loaded again when that restarts."""
        component = self._components[name]
        container = self._container(_key(component))
        if self._stopped:
            return
        if name in container.todo or name in container.there or component == container.current:
            self._around.journal.say(f"{shown(name)} is not loaded once more")
            return
        self._filled[_key(component)] = container
        container.wanted[name] = container.todo[name] = component
        if container.over is not None:
            self._give_up(container, container.over)
        self._go_on(container)

    def started(self, process: str, environment: Mapping[str, str]) -> None:
        """A container runs."""
        container = self._container(process)
        container.environment, container.over = environment, None
        container.todo = dict(container.wanted)
        self._go_on(container)

    def ended(self, process: str) -> list[Component]:
        """One run of a container is over: return what went with it."""
        container = self._containers.get(process)
        if container is None:
            return []
        lost = [*container.there.values()]
        if container.current:
            self._orders.withdraw(_name(container.current))
            container.todo = {container.current.id: container.current, **container.todo}
        container.current = container.environment = None
        container.there.clear()
        return lost

    def never(self, process: str, reason: str) -> None:
        """A container will not run (again): what is still to be loaded into it fails."""
        container = self._container(process)
        container.over = reason
        self._give_up(container, reason)

    def stop(self) -> None:
        """The run ends: nothing is loaded any more."""
        self._stopped = True
        for container in self._containers.values():
            container.todo.clear()
            if container.current:
                self._orders.withdraw(_name(container.current))
                container.current = None

    def _container(self, key: str) -> _Container:
        if key not in self._containers:
            self._containers[key] = _Container()
        return self._containers[key]

    def _go_on(self, container: _Container) -> None:
        if container.environment is None or container.current or not container.todo:
            return
        name, component = next(iter(container.todo.items()))
        del container.todo[name]
        container.current = component
        message = {"do": "load", "container": component.container, "component": _request(component)}
        service = f"{component.container}/_container/load_node"
        self._orders.give(
            Order(_name(component), message, service, container.environment),
            partial(self._done, container, component),
            partial(self._refused, container, component),
        )

    def _done(self, container: _Container, component: Component, message: dict[str, Any]) -> None:
        container.current = None
        container.there[component.id] = component
        node = message["node"]
        self._around.recorder.record(
            "component_loaded",
            component.id,
            node=node,
            container=component.container,
            unique_id=message["unique_id"],
        )
        self._around.journal.say(f"{shown(component.id)} is loaded into {shown(component.container)}")
        if container.environment is not None:
            self._loaded(component, node, container.environment)
        self._go_on(container)

    def _refused(self, container: _Container, component: Component, refusal: Refusal) -> None:
        container.current = None
        self._failed(component, refusal.reason)
        if refusal.absent:
            self._give_up(container, refusal.reason)  # each of the others would wait as long, and in vain
        self._go_on(container)

    def _give_up(self, container: _Container, reason: str) -> None:
        todo, container.todo = container.todo, {}
        for component in todo.values():
            self._failed(component, reason)

    def _failed(self, component: Component, reason: str) -> None:
        self._around.recorder.record(
            "component_failed", component.id, container=component.container, reason=reason
        )
        self._went_wrong(
            f"{shown(component.id)} could not be loaded into {shown(component.container)}: {reason}"
        )


def _key(component: Component) -> str:
    """Return what tells containers apart; no process has an id with a blank in front."""
    return component.process if component.process is not None else f" {component.container}"


def _name(component: Component) -> str:
    return f"component {component.id}"


def _request(component: Component) -> dict[str, Any]:
    """Return what composition_interfaces/srv/LoadNode wants to know."""
    return {
        "package_name": component.package,
        "plugin_name": component.plugin,
        "node_name": component.name or "",
        "node_namespace": component.namespace or "",
        "remap_rules": [f"{old}:={new}" for old, new in component.remappings],
        "parameters": component.parameters,
        "extra_arguments": component.extra_arguments,
    }

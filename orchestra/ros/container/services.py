"""What a container answers: `load_node`, `unload_node`, `list_nodes`."""

from __future__ import annotations

import gc
import traceback
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from rclpy.logging import LoggingSeverity, set_logger_level

from orchestra.ros.container.component import made, take_away
from orchestra.ros.container.plugins import Plugins
from orchestra.ros.container.refusal import RefusalError
from orchestra.ros.container.request import given_by
from orchestra.ros.interfaces.definitions import provide

if TYPE_CHECKING:
    from rclpy.node import Node

    from orchestra.ros.container.component import Component
    from orchestra.ros.container.hosting import Hosting

_PACKAGE: Final = "composition_interfaces"
_SERVICES: Final = "~/_container"


class Container:
    """Loads components and lets them go. Numbers are given once."""

    def __init__(self, manager: Node, hosting: Hosting) -> None:
        self._log = manager.get_logger()
        self._hosting = hosting
        self._plugins = Plugins()
        self._components: dict[int, Component] = {}
        self._latest = 0
        provide(_PACKAGE)
        types = import_module(f"{_PACKAGE}.srv")
        manager.create_service(types.LoadNode, f"{_SERVICES}/load_node", self._load)
        manager.create_service(types.UnloadNode, f"{_SERVICES}/unload_node", self._unload)
        manager.create_service(types.ListNodes, f"{_SERVICES}/list_nodes", self._list)

    def component_of(self, node: Node | None) -> Component | None:
        """Return the component that a node belongs to."""
        return next((one for one in self._components.values() if node in one.nodes), None)

    def close(self) -> None:
        """Let all components go, the latest first."""
        for number in reversed([*self._components]):
            self._let_go(self._components.pop(number))

    def _load(self, request: Any, response: Any) -> Any:  # noqa: ANN401 - of an untyped package
        try:
            number, component = self._loaded(request)
        except RefusalError as error:
            self._refuse(request, str(error), response)
        except (Exception, SystemExit) as error:  # noqa: BLE001 - importing runs a component's own code
            self._log.error(traceback.format_exc())
            self._refuse(request, f"{type(error).__name__}: {error}", response)
        else:
            response.success, response.unique_id = True, number
            response.full_node_name = component.name
        return response

    def _refuse(self, request: Any, reason: str, response: Any) -> None:  # noqa: ANN401 - as above
        self._log.error(
            f"'{request.plugin_name}' of package '{request.package_name}' is not loaded: {reason}"
        )
        response.success, response.error_message = False, reason

    def _loaded(self, request: Any) -> tuple[int, Component]:  # noqa: ANN401 - as above
        given = given_by(request)
        make = self._plugins.find(request.package_name, request.plugin_name)
        component = made(make, request.node_name, given, self._log.error)
        if request.log_level:
            _set_level(component, request.log_level)
        self._latest += 1
        self._components[self._latest] = component
        self._hosting.add(component.node)
        self._log.info(f"loaded {component.name} as component {self._latest}")
        return self._latest, component

    def _unload(self, request: Any, response: Any) -> Any:  # noqa: ANN401 - as above
        number = request.unique_id
        component = self._components.pop(number, None)
        if component is None:
            response.success = False
            response.error_message = f"No node found with unique_id: {number}"
            self._log.warning(response.error_message)
            return response
        name = component.name
        self._let_go(component)
        del component
        gc.collect()  # nodes refer to themselves
        self._log.info(f"unloaded {name}")
        response.success = True
        return response

    def _list(self, _request: Any, response: Any) -> Any:  # noqa: ANN401 - as above
        response.unique_ids = [*self._components]
        response.full_node_names = [component.name for component in self._components.values()]
        return response

    def _let_go(self, component: Component) -> None:
        if not self._hosting.remove(component.node):
            self._log.warning(f"{component.name} goes while a callback of it is at work")
        self._hosting.between(lambda: take_away(component.nodes, self._log.error))


def _set_level(component: Component, level: int) -> None:
    """Set the level of a component's logger, a number of rcl_interfaces/msg/Log."""
    try:
        severity = LoggingSeverity(level)
    except ValueError:
        return
    set_logger_level(component.node.get_logger().name, severity)

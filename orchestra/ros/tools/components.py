"""`component list`, `component load`, `component unload`."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from rcl_interfaces.msg import Parameter

from orchestra.errors import RunError, UsageError
from orchestra.ros.interfaces.definitions import provide
from orchestra.ros.observer.service import OwnService
from orchestra.ros.tools.graph.asking import Deadline, ask
from orchestra.ros.tools.graph.joining import joined
from orchestra.ros.tools.graph.names import NO_CONTAINER, absolute, nodes, services, unknown
from orchestra.ros.tools.parameter_values import value_of_text
from orchestra.ros.tools.telling import tell

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

    from orchestra.ros.tools.graph.joining import Graph

_PACKAGE: Final = "composition_interfaces"
_LOAD: Final = "/_container/load_node"
_TYPE: Final = f"{_PACKAGE}/srv/LoadNode"
# rcl_interfaces/msg/Log
_LEVELS: Final = {"debug": 10, "info": 20, "warn": 30, "error": 40, "fatal": 50}


def list_components(options: Namespace) -> int:
    """Write the containers, and what each of them has loaded."""
    with joined(options) as graph:
        names = (
            graph.whole(lambda: containers(graph))
            if options.container is None
            else [container(graph, options.container)]
        )
        if options.containers_only:
            tell(options, "".join(f"{name}\n" for name in names), names)
            return 0
        found = {name: _loaded(graph, name, Deadline(options.timeout)) for name in names}
    alone = options.container is not None
    text = "".join(_shown(name, loaded, alone=alone) for name, loaded in found.items())
    data = {name: [{"uid": uid, "name": node} for uid, node in loaded] for name, loaded in found.items()}
    tell(options, text, data)
    return 0


def load(options: Namespace) -> int:
    """Load a component into a container."""
    deadline, request = Deadline(options.timeout), asked_for(options)
    with joined(options) as graph:
        name = container(graph, options.container)
        answer = loaded_into(graph, name, request, deadline)
    uid, node = answer.unique_id, answer.full_node_name
    text = (
        f"{uid}  {node}\n"
        if options.quiet
        else f"Loaded component {uid} into '{name}' container node as '{node}'\n"
    )
    tell(options, text, {"container": name, "uid": uid, "name": node})
    return 0


def unload(options: Namespace) -> int:
    """Unload components, one after another, as long as that goes well."""
    deadline = Deadline(options.timeout)
    kind = _type("UnloadNode")
    with joined(options) as graph:
        name = container(graph, options.container)
        for uid in options.numbers:
            answer = _ordered(
                graph, kind, f"{name}/_container/unload_node", kind.Request(unique_id=uid), deadline
            )
            if not answer.success:
                told = f"Failed to unload component {uid} from '{name}' container node"
                raise RunError(f"{told}: {answer.error_message}")
            shown = (
                f"{uid}  {name}\n"
                if options.quiet
                else f"Unloaded component {uid} from '{name}' container node\n"
            )
            tell(options, shown, {"container": name, "uid": uid})
    return 0


def loaded_into(graph: Graph, name: str, request: Any, deadline: Deadline) -> Any:  # noqa: ANN401 - untyped package
    """Return what a container answers to a request to load a component. Raises `RunError` where it refuses."""
    kind = _type("LoadNode")
    answer = _ordered(graph, kind, f"{name}{_LOAD}", request, deadline)
    if not answer.success:
        reason = answer.error_message or "the container gives no reason"
        raise RunError(f"Failed to load component: {reason}")
    return answer


def asked_for(options: Namespace) -> Any:  # noqa: ANN401 - of an untyped package
    """Return a request to load with all that the options say. Raises `UsageError`."""
    request = _type("LoadNode").Request()
    request.package_name, request.plugin_name = options.package, options.plugin
    request.node_name, request.node_namespace = options.node_name, options.node_namespace
    request.log_level = _LEVELS.get(options.log_level, 0)
    request.remap_rules = [":=".join(_halves(rule, "FROM:=TO")) for rule in options.remap_rule]
    request.parameters = _values(options.parameter)
    request.extra_arguments = _values(options.extra_argument)
    return request


def containers(graph: Graph) -> list[str]:
    """Return the full names of the containers."""
    there = {name for name, types in services(graph) if name.endswith(_LOAD) and _TYPE in types}
    return sorted({full for full in nodes(graph, every=True) if full + _LOAD in there})


def container(graph: Graph, name: str) -> str:
    """Return the full name of a container that is there. Raises `RunError`."""
    full = absolute(name)
    if not graph.found(lambda: full in containers(graph)):
        if full in nodes(graph, every=True):
            raise RunError(f"{full} is no container")
        raise unknown(NO_CONTAINER, full, containers(graph))
    return full


def _ordered(graph: Graph, kind: Any, service: str, request: Any, deadline: Deadline) -> Any:  # noqa: ANN401 - untyped package
    """Return the answer to what must not be asked twice.

    An answer that comes before the container has discovered its reader is lost, so something harmless is asked first,
    when that reader is there: readers are discovered in the order in which they were made.
    """
    client, answers = OwnService(graph.node, kind, service), list[Any]()
    try:
        _loaded(graph, service.partition("/_container/")[0], deadline)
        if graph.wait(lambda: client.ready, deadline.left):
            client.ask(request, answers.append)
        if not graph.wait(lambda: answers, deadline.left):
            raise RunError(f"the service {service} did not answer within {deadline}")
    finally:
        client.close()
    return answers[0]


def _loaded(graph: Graph, name: str, deadline: Deadline) -> list[tuple[int, str]]:
    kind = _type("ListNodes")
    answer = ask(graph, kind, f"{name}/_container/list_nodes", kind.Request(), deadline)
    return list(zip(map(int, answer.unique_ids), answer.full_node_names, strict=True))


def _shown(name: str, loaded: Sequence[tuple[int, str]], *, alone: bool) -> str:
    indent = "" if alone else "  "
    rows = "".join(f"{indent}{uid}  {node}\n" for uid, node in loaded)
    return rows if alone else f"{name}\n{rows}"


def _values(words: Sequence[str]) -> list[Parameter]:
    pairs = (_halves(word, "NAME:=VALUE") for word in words)
    return [Parameter(name=name, value=value_of_text(value)) for name, value in pairs]


def _halves(word: str, form: str) -> tuple[str, str]:
    name, sign, value = word.partition(":=")
    if not sign or not name:
        raise UsageError(f"'{word}' is not {form}")
    return name, value


def _type(name: str) -> Any:  # noqa: ANN401 - of an untyped package
    provide(_PACKAGE)
    return getattr(import_module(f"{_PACKAGE}.srv"), name)

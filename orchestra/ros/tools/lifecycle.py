"""`lifecycle nodes`, `lifecycle get`, `lifecycle list`, `lifecycle set`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from lifecycle_msgs.srv import ChangeState, GetAvailableTransitions, GetState

from orchestra.errors import RunError
from orchestra.ros.observer.transitions import consequence
from orchestra.ros.tools.graph.asking import Deadline, ask
from orchestra.ros.tools.graph.names import NO_NODE, absolute, nodes, services, unknown
from orchestra.ros.tools.graph.seeing import looking
from orchestra.ros.tools.telling import lines, tell, warn

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.ros.tools.graph.seeing import Graph

_SERVICE: Final = "/get_state"
_TYPE: Final = "lifecycle_msgs/srv/GetState"


def list_nodes(options: Namespace) -> int:
    """Write the names of the nodes with a lifecycle."""
    with looking(options) as graph:
        found = graph.whole(lambda: _nodes(graph, every=options.all))
    if options.count_nodes:
        tell(options, f"{len(found)}\n", len(found))
    else:
        tell(options, lines(found), found)
    return 0


def get(options: Namespace) -> int:
    """Write the state of a node, or of all that have one."""
    with looking(options) as graph:
        if options.node is not None:
            full = _node(graph, options.node)
            state = _state(graph, full, options)
            tell(options, f"{_labelled(state)}\n", {"node": full, **_data(state)})
            return 0
        silent, rows = [], []
        for full in graph.whole(lambda: _nodes(graph, every=options.include_hidden_nodes)):
            try:
                rows.append((full, _state(graph, full, options)))
            except RunError as error:
                silent.append(str(error))
    text = lines(f"{full}: {_labelled(state)}" for full, state in rows)
    tell(options, text, [{"node": full, **_data(state)} for full, state in rows])
    for reason in silent:
        warn(f"warning: {reason}")
    return 1 if silent else 0


def list_transitions(options: Namespace) -> int:
    """Write the transitions that a node can make now, or all that there are."""
    service = "get_transition_graph" if options.all else "get_available_transitions"
    with looking(options) as graph:
        full = _node(graph, options.node)
        found = _transitions(graph, full, service, Deadline(options.timeout))
    text = "".join(
        f"- {_labelled(one.transition)}\n\tStart: {one.start_state.label}\n\tGoal: {one.goal_state.label}\n"
        for one in found
    )
    data = [
        {**_data(one.transition), "start": one.start_state.label, "goal": one.goal_state.label}
        for one in found
    ]
    tell(options, text, data)
    return 0


def set_state(options: Namespace) -> int:
    """Make a node change its state."""
    deadline = Deadline(options.timeout)
    with looking(options) as graph:
        full = _node(graph, options.node)
        there = _transitions(graph, full, "get_available_transitions", deadline)
        available = [one.transition for one in there]
        wanted = [one for one in available if options.transition in (one.label, str(one.id))]
        if not wanted:
            rows = "".join(f"\n- {_labelled(one)}" for one in available) or " none at all"
            raise RunError(f"Unknown transition requested, available ones are:{rows}")
        request = ChangeState.Request()
        request.transition.id, request.transition.label = wanted[0].id, wanted[0].label
        answer = ask(
            *(graph, ChangeState, f"{full}/change_state", request, deadline),
            repeat=False,
            asking=lambda: _state(graph, full, options),
        )
        if not answer.success:
            state = _state(graph, full, options)
            because = consequence(there[0].start_state.label, state.label)
            raise RunError(f"Transitioning failed: {full} is {_labelled(state)} now{because}")
    tell(options, "Transitioning successful\n", {"node": full, **_data(wanted[0]), "successful": True})
    return 0


def _nodes(graph: Graph, *, every: bool) -> list[str]:
    there = {name for name, types in services(graph) if name.endswith(_SERVICE) and _TYPE in types}
    return sorted({full for full in nodes(graph, every=every) if full + _SERVICE in there})


def _node(graph: Graph, name: str) -> str:
    full = absolute(name)
    if not graph.found(lambda: full in _nodes(graph, every=True)):
        if full in nodes(graph, every=True):
            raise RunError(f"{full} has no lifecycle")
        raise unknown(NO_NODE, full, _nodes(graph, every=False) or nodes(graph))
    return full


def _state(graph: Graph, full: str, options: Namespace) -> Any:  # noqa: ANN401 - of an untyped package
    return ask(graph, GetState, full + _SERVICE, GetState.Request(), Deadline(options.timeout)).current_state


def _transitions(graph: Graph, full: str, service: str, deadline: Deadline) -> list[Any]:
    request = GetAvailableTransitions.Request()
    answer = ask(graph, GetAvailableTransitions, f"{full}/{service}", request, deadline)
    return list(answer.available_transitions)


def _labelled(one: Any) -> str:  # noqa: ANN401 - as above
    return f"{one.label} [{one.id}]"


def _data(one: Any) -> dict[str, Any]:  # noqa: ANN401 - as above
    return {"label": one.label, "id": one.id}

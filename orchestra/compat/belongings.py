"""Arguments that a class does not take, and what takes them: a call around it, one in it, or one that is missing."""

from __future__ import annotations

import ast
import re
from importlib import import_module
from typing import TYPE_CHECKING, Final

from orchestra.compat.borrowed import ROOM
from orchestra.compat.keywords import parameters_of
from orchestra.compat.literals import call_at
from orchestra.compat.syntax_trees import called_by, tree_of
from orchestra.compat.whereabouts import exporting
from orchestra.errors import Code

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from orchestra.compat.place import Place
    from orchestra.errors import Problem

_BELONGS: Final = re.compile(r"has no argument '(\w+)': it belongs to (\w+)")
# What does for a class what an argument does elsewhere.
_INSTEAD: Final = {
    "additional_env": "SetEnvironmentVariable(name, value)",
    "args": "launch_arguments of IncludeLaunchDescription",
    "choices": "DeclareLaunchArgument",
    "delay": "TimerAction(period=..., actions=[...])",
    "description": "DeclareLaunchArgument",
    "env": "SetEnvironmentVariable(name, value)",
    "namespace": "PushRosNamespace in a GroupAction",
    "on_completion": "RegisterEventHandler(OnExecutionComplete(...))",
    "on_start": "RegisterEventHandler(OnProcessStart(...))",
    "on_stdout": "RegisterEventHandler(OnProcessIO(...))",
    "parameters": "SetParameter in a GroupAction",
    "period": "TimerAction(period=..., actions=[...])",
    "remappings": "SetRemap in a GroupAction",
    "use_sim_time": "SetParameter('use_sim_time', ...)",
    "value_type": "ParameterValue",
}
_OF_NODES: Final = {
    "use_sim_time": "parameters=[{'use_sim_time': ...}]",
    "frame_id": "parameters=[{'frame_id': ...}]",
    "composable_node_descriptions": "ComposableNodeContainer",
    "launch_arguments": "IncludeLaunchDescription",
}
_NODES: Final = frozenset({"ComposableNode", "ComposableNodeContainer", "LifecycleNode", "Node"})
_GROUPS: Final = frozenset({"GroupAction", "IncludeLaunchDescription"})
_INCLUDES: Final = frozenset({"IncludeLaunchDescription"})


def without_needs(problems: Iterable[Problem]) -> Callable[[Problem], Problem | None]:
    """Return what leaves out that a class needs an argument which stands, by mistake, beside the call of it."""
    told = [_BELONGS.search(problem.message) for problem in problems if problem.code is Code.UNKNOWN_KEY]
    misplaced = {f"{found[2]} needs '{found[1]}'" for found in told if found is not None}

    def kept(problem: Problem) -> Problem | None:
        return None if problem.code is Code.MISSING_KEY and problem.message in misplaced else problem

    return kept


def owner_of(name: str, called: str, places: tuple[Place, ...]) -> str | None:
    """Return what takes an argument that a class does not take, None where that is not known."""
    instead = _INSTEAD.get(name)
    if called in _INCLUDES and name in ("parameters", "arguments", "params"):
        return "launch_arguments are what an included file takes"
    if called in _GROUPS and instead is not None and not instead.startswith(("launch_arguments", called)):
        return f"{instead} does that"
    for place in places:
        for other in _near(place):
            if other != called and _takes(other, name):
                return f"it belongs to {other}"
    if called in _NODES and name in _OF_NODES:
        return f"{_OF_NODES[name]} has it"
    return None if instead is None or instead.startswith(called) else f"{instead} does that"


def _near(place: Place) -> Iterator[str]:
    """Yield the classes that are called around a call, innermost first, and in it."""
    call, tree = call_at(place), tree_of(place.file)
    if call is None or tree is None:
        return
    around = [
        node
        for node in tree.nodes
        if isinstance(node, ast.Call) and node is not call and any(item is call for item in ast.walk(node))
    ]
    inside = [node for node in ast.walk(call) if isinstance(node, ast.Call) and node is not call]
    for node in (*around[::-1], *inside):
        name = called_by(node)
        if name is not None and name[:1].isupper():
            yield name


def _takes(kind: str, name: str) -> bool:
    """Return whether a class of the launch language takes an argument."""
    packages = exporting(kind)
    made = getattr(import_module(f"{ROOM}.{packages[0]}"), kind, None) if packages else None
    return isinstance(made, type) and any(item.name == name for item in parameters_of(made))

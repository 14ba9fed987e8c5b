"""`LaunchIntrospector`: a launch description as text, before anything is visited."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.compat.described import described
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_description import LaunchDescription

_Tree: TypeAlias = tuple[str, list["_Tree"]]


class LaunchIntrospector:
    """Describes what is known without a visit: included files and the content of groups are not.

    Upstream writes addresses of objects, which differ from run to run; here is where each object was made.
    """

    def format_launch_description(self, launch_description: LaunchDescription) -> str:
        """Return a tree, one entity in a line; substitutions are described, not performed."""
        entities = launch_description.entities
        head = f"LaunchDescription({len(entities)} {'entity' if len(entities) == 1 else 'entities'})"
        return "\n".join((head, *_drawn([_tree(entity) for entity in entities], "")))


def _drawn(trees: list[_Tree], before: str) -> Iterator[str]:
    for index, (text, inside) in enumerate(trees):
        last = index == len(trees) - 1
        yield f"{before}{'└── ' if last else '├── '}{text}"
        yield from _drawn(inside, before + ("    " if last else "│   "))


def _tree(entity: Any) -> _Tree:
    for kind in type(entity).__mro__:
        form = _FORMS.get(kind.__name__) if kind.__module__.startswith("orchestra.compat.") else None
        if form is not None:
            return form(entity)
    return f"Action('{_named(entity)}')", []


def _named(entity: Any) -> str:
    """Return what kind of entity it is, and where it was made."""
    place = getattr(entity, "_place", None)
    name = type(entity).__name__
    return name if place is None else f"{name} at {place.span}"


def _log_info(action: Any) -> _Tree:
    return f"LogInfo({described(action.msg)})", []


def _emit_event(action: Any) -> _Tree:
    return f"EmitEvent(event='{action.event.name}')", []


def _declaration(action: Any) -> _Tree:
    default = "" if action.default_value is None else f", default={described(action.default_value)}"
    return f"DeclareLaunchArgument('{action.name}'{default}, description='{action.description}')", []


def _opaque_function(action: Any) -> _Tree:
    name = getattr(action.function, "__qualname__", repr(action.function)).rpartition(".")[2]
    return f"OpaqueFunction(function={name})", []


def _execute_process(action: Any) -> _Tree:
    words = ", ".join(described(normalized(word)) for word in action.cmd)
    cwd = None if action.cwd is None else described(normalized(action.cwd))
    return (
        f"{type(action).__name__}(cmd=[{words}], cwd={cwd}, env={_environment(action.env)}, shell={action.shell})",
        [],
    )


def _environment(env: Any) -> str:
    if env is None:
        return "None"
    items = env.items() if isinstance(env, dict) else env
    pairs = (f"{described(normalized(name))}: {described(normalized(value))}" for name, value in items)
    return f"{{{', '.join(pairs)}}}"


def _register(action: Any) -> _Tree:
    text, entities = action.event_handler.describe()
    inside = [_tree(entity) for entity in (entities if isinstance(entities, Iterable) else [entities])]
    return f"RegisterEventHandler('{type(action.event_handler).__name__}'):", [(text, inside)]


_FORMS: dict[str, Callable[[Any], _Tree]] = {
    "DeclareLaunchArgument": _declaration,
    "EmitEvent": _emit_event,
    "ExecuteProcess": _execute_process,
    "LogInfo": _log_info,
    "OpaqueFunction": _opaque_function,
    "RegisterEventHandler": _register,
}

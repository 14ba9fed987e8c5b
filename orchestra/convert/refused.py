"""Why an action of a Python launch file cannot be said in the launch language."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.actions.emit_event import EmitEvent
from orchestra.description.actions.opaque import OpaqueAction
from orchestra.description.actions.register_event_handler import RegisterEventHandler
from orchestra.description.actions.shutdown import Shutdown

if TYPE_CHECKING:
    from orchestra.description.entity import Action

_ACTIONS: Final = {
    "LifecycleTransition": "LifecycleTransition",
    "PopEnvironment": "PopEnvironment",
    "PopLaunchConfigurations": "PopLaunchConfigurations",
    "PushEnvironment": "PushEnvironment",
    "PushLaunchConfigurations": "PushLaunchConfigurations",
    "UnregisterEventHandler": "UnregisterEventHandler",
    "UnsetLet": "UnsetLaunchConfiguration",
}
_AT_ITS_END: Final = ("OnExecutionComplete", "OnProcessExit")
# What lets one process wait for another, where a handler starts it.
_ALIKE: Final = {"OnExecutionComplete": "completed", "OnProcessExit": "exited", "OnProcessStart": "started"}


def why(action: Action) -> str:
    """Return one sentence."""
    if isinstance(action, OpaqueAction):
        name = type(action.target).__name__
        function = getattr(getattr(action.target, "function", None), "__name__", None)
        called = "" if function is None else f" of {function}()"
        return f"only Python code knows what this {name}{called} does"
    if isinstance(action, RegisterEventHandler):
        names = sorted({type(handler.origin).__name__ for handler in action.handlers})
        return f"only Python has event handlers ({', '.join(names)}){_near(names, action)}"
    if isinstance(action, EmitEvent):
        return f"only Python can emit events ({type(action.event).__name__})"
    return f"only Python has {_ACTIONS.get(type(action).__name__, type(action).__name__)}"


def _near(names: list[str], action: RegisterEventHandler) -> str:
    """Return what comes near to a handler, with what stands before it."""
    done = [child for handler in action.handlers for child in handler.children or ()]
    if done and names[0] in _AT_ITS_END and all(map(_ends_the_run, done)):
        return "; near to it is `on_exit: shutdown` on the process"
    alike = next((_ALIKE[name] for name in names if name in _ALIKE), None)
    return "" if alike is None else f"; near to it is `depends_on` with `condition: {alike}` on what follows"


def _ends_the_run(action: Action) -> bool:
    return isinstance(action, Shutdown) or (
        isinstance(action, EmitEvent) and type(action.event).__name__ == "Shutdown"
    )

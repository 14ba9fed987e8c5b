"""Objects that stand where an action should, and what they are meant for."""

from __future__ import annotations

from typing import Any, Final

from orchestra.compat.explanation import told

# By the name of a class, its own or one that it derives from: whoever has such an object has imported it.
_USES: Final = {
    "BaseEventHandler": "RegisterEventHandler(...) takes it",
    "ComposableNode": "ComposableNodeContainer(...) and LoadComposableNodes(...) load it",
    "Event": "EmitEvent(event=...) takes it",
    "LaunchDescriptionSource": "IncludeLaunchDescription(...) takes it",
    "function": "OpaqueFunction(function=...) calls it",
    "list": "a * before it makes its items part of the list around it",
    "str": "IncludeLaunchDescription(...) includes a launch file",
    "tuple": "a * before it makes its items part of the list around it",
    "type": "brackets after the class make an object of it",
}


def misplaced(value: Any) -> tuple[str, tuple[str, ...]]:
    """Return what to say of something that is no action: a message, and notes that may help."""
    uses = (_USES.get(kind.__name__) for kind in type(value).__mro__)
    return f"an action is expected here, this is {told(value)}", tuple(
        use for use in uses if use is not None
    )[:1]

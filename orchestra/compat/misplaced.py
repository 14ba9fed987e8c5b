"""Objects that stand where an action should, and what they are meant for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import told
from orchestra.errors import Code, Problem, Severity

if TYPE_CHECKING:
    from orchestra.compat.place import Place

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


def refuse_entity(value: Any, place: Place) -> None:
    """Report what a call adds to a launch description in place of an action."""
    # Here, because only mistakes need them, and what they import.
    from orchestra.compat.literals import argument  # noqa: PLC0415
    from orchestra.compat.remarks import report  # noqa: PLC0415
    from orchestra.compat.rewritten import rewritten  # noqa: PLC0415

    message, notes = misplaced(value)
    written = argument(place, ("*0",))
    is_one = isinstance(value, list | tuple) or written.node is None
    meant = None if is_one else rewritten(place.file, written.whole, value, message)
    report(Problem(Code.WRONG_TYPE, Severity.ERROR, message, written.whole, (), meant, notes))


def misplaced(value: Any) -> tuple[str, tuple[str, ...]]:
    """Return what to say of something that is no action: a message, and notes that may help."""
    uses = (_USES.get(kind.__name__) for kind in type(value).__mro__)
    return f"an action is expected here, this is {told(value)}", tuple(
        use for use in uses if use is not None
    )[:1]

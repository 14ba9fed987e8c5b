"""Objects that stand where an action should, and what they are meant for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import told
from orchestra.errors import Code, Problem, Severity

if TYPE_CHECKING:
    from orchestra.compat.place import Place
    from orchestra.compat.thrown_away import Fault
    from orchestra.location import Span

# By the name of a class, its own or one that it derives from: what takes such an object, and what may help else.
_TAKERS: Final = {
    "BaseEventHandler": "RegisterEventHandler(...) takes it",
    "ComposableNode": "the composable_node_descriptions of a container take it",
    "Condition": "the condition of an action is one",
    "Event": "EmitEvent(event=...) takes it",
    "Substitution": "an action takes it as a text",
    "LaunchDescriptionSource": "IncludeLaunchDescription(...) takes it",
    "function": "OpaqueFunction(function=...) calls it",
}
_HELP: Final = {
    "list": "a * before it makes its items part of the list around it",
    "str": "IncludeLaunchDescription(...) includes a launch file",
    "tuple": "a * before it makes its items part of the list around it",
    "type": "brackets after the class make an object of it",
}
_EACH: Final = "they are added one by one: for action in actions: ld.add_action(action)"


def refuse_entity(value: Any, place: Place) -> None:
    """Report what a call adds to a launch description in place of an action."""
    # Here, because only mistakes need them, and what they import.
    from orchestra.compat.literals import argument  # noqa: PLC0415
    from orchestra.compat.remarks import report  # noqa: PLC0415
    from orchestra.compat.rewritten import rewritten  # noqa: PLC0415

    message, notes = misplaced(value)
    written = argument(place, ("*0",))
    fault = None if value is not None else _of_helper(place.file, written.whole)
    if fault is not None:
        report(Problem(Code.WRONG_TYPE, Severity.ERROR, fault.message, fault.span, (), fault.suggestion))
        return
    if isinstance(value, list | tuple):
        notes = (_EACH,)
    is_one = not isinstance(value, list | tuple) or len(value) == 1
    meant = rewritten(place.file, written.whole, value, message) if is_one and written.node else None
    meant = None if meant is not None and meant.startswith("*") else meant
    report(Problem(Code.WRONG_TYPE, Severity.ERROR, message, written.whole, (), meant, notes))


def _of_helper(file: str, span: Span) -> Fault | None:
    from orchestra.compat.thrown_away import called_without_return  # noqa: PLC0415 - only mistakes need it

    return called_without_return(file, span)


def misplaced(value: Any) -> tuple[str, tuple[str, ...]]:
    """Return what to say of something that is no action: a message, and notes that may help."""
    kinds = _kinds(value)
    taker = taken_by(value)
    helping = tuple(_HELP[kind] for kind in kinds if kind in _HELP)
    return f"an action is expected here, this is {told(value)}{taker}", helping[:1]


def is_list_at(span: Span) -> bool:
    """Return whether a list, or the name of one, is all that stands at a place."""
    # Here, because only mistakes need them.
    import ast  # noqa: PLC0415

    from orchestra.compat.syntax_trees import tree_of  # noqa: PLC0415

    file = str(Path(span.file).absolute())
    tree = tree_of(file)
    node = None if tree is None else tree.expression(file, span)
    return isinstance(node, ast.List | ast.Name | ast.Tuple)


def taken_by(value: Any) -> str:
    """Return what takes something that is no action, for the end of a message."""
    kinds = _kinds(value)
    taker = next((f": {_TAKERS[kind]}" for kind in kinds if kind in _TAKERS), "")
    is_end = kinds[0] == "Shutdown" and "Event" in kinds
    return f"{taker}, and launch.actions.Shutdown is an action" if is_end else taker


def _kinds(value: Any) -> list[str]:
    return [kind.__name__ for kind in type(value).__mro__]

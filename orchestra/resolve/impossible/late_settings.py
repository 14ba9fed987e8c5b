"""Settings behind everything that they could count for: a namespace that is pushed when all nodes are there already.

They count for what follows them, in a group that has a scope of its own for nothing outside of it. Such a group of
nothing but settings has no effect at all; in Python it is left alone: what it holds may be made by code.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.actions.opaque import OpaqueAction
from orchestra.errors import Code, Severity
from orchestra.location import is_python

if TYPE_CHECKING:
    from collections.abc import Sequence
    from collections.abc import Set as AbstractSet

    from orchestra.description.entity import Action
    from orchestra.resolve.resolution import Resolution

_ENVIRONMENT: Final = frozenset({"AppendEnv", "SetEnv", "UnsetEnv"})
SETTINGS: Final = _ENVIRONMENT | {
    "PushRosNamespace",
    "SetParameter",
    "SetParametersFromFile",
    "SetRemap",
    "SetUseSimTime",
}
_BESIDE: Final = SETTINGS | {"Arg", "Let", "Log", "UnsetLet"}  # no setting counts for these
_NODES: Final = frozenset({"Include", "LifecycleNode", "LoadComposableNode", "Node", "NodeContainer"})
_PROCESSES: Final = _NODES | {"Executable"}


def check_late(children: Sequence[Action], run: Resolution, *, settings: AbstractSet[str] = SETTINGS) -> None:
    """Tell of settings in a scope that nothing follows although what they could count for stands before them."""
    if not children or type(children[-1]).__name__ not in _BESIDE:
        return
    names = [type(child).__name__ for child in children]
    last = _last(names)
    before = _started(children[:last])
    for child, name in zip(children[last:], names[last:], strict=True):
        if name in settings and before & (_PROCESSES if name in _ENVIRONMENT else _NODES):
            what = "process" if name in _ENVIRONMENT else "node"
            message = f"this counts for what follows it, and no {what} does"
            run.problems.warning(Code.IDLE_KEY, message, run.at(child.span))


def check_alone(children: Sequence[Action], run: Resolution) -> None:
    """Tell of a group, which has a scope of its own, in which nothing is that its settings count for."""
    names = [type(child).__name__ for child in children]
    first = next((child for child, name in zip(children, names, strict=True) if name in SETTINGS), None)
    if first is None or _last(names) or is_python(run.at(first.span)):
        return
    here = run.at(first.span).span.file
    if any(item.severity is Severity.ERROR and item.span and item.span.file == here for item in run.problems):
        return  # what was left out for a fault may have stood there
    message = "this counts for what follows it in its group, and nothing does"
    run.problems.warning(Code.IDLE_KEY, message, run.at(first.span))


def _last(names: Sequence[str]) -> int:
    """Return behind which of the actions with these names there is nothing that settings count for."""
    return max((at for at, name in enumerate(names, 1) if name not in _BESIDE), default=0)


def _started(actions: Sequence[Action]) -> set[str]:
    """Return the kinds of actions that stand in a list and in its groups."""
    found = {type(action).__name__ for action in actions}
    for action in actions:
        found |= _started(getattr(action, "children", None) or ())
    return found


def check_late_in_file(children: Sequence[Action], run: Resolution) -> None:
    """Do the same for all of a description: what is carried out when something happens sees what is set until then.

    Variables of the environment are left alone: people end files with one that does no harm, or set it for includers.
    """
    if not run.found.occasions.late and not any(isinstance(child, OpaqueAction) for child in children):
        check_late(children, run, settings=SETTINGS - _ENVIRONMENT)

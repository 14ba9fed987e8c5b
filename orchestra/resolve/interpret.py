"""The depth-first visit of a description, in upstream's order: each action sees what came before it."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any, Protocol

from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import is_python
from orchestra.resolve.booleans import PLAIN_CONDITIONS, boolean
from orchestra.resolve.context import Value
from orchestra.resolve.impossible.comparisons import check_comparisons
from orchestra.resolve.impossible.contradictions import check_contradiction, held
from orchestra.resolve.impossible.late_settings import check_late_in_file
from orchestra.resolve.mentions import hidden, words_in
from orchestra.resolve.model import ResolvedSkip
from orchestra.resolve.resolution import MOST_STEPS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.description.entity import Action, Conditional
    from orchestra.description.launch import Description
    from orchestra.description.text import Template
    from orchestra.resolve.impossible.held import Held
    from orchestra.resolve.resolution import Resolution

VISITORS: dict[str, str] = {
    "AppendEnv": "append_env",
    "Arg": "arg",
    "EmitEvent": "emit_event",
    "Executable": "executable",
    "ForEachLoop": "for_each",
    "ForLoop": "for_loop",
    "Group": "group",
    "Include": "include",
    "Let": "let",
    "LifecycleNode": "lifecycle_node",
    "LifecycleTransition": "lifecycle_transition",
    "LoadComposableNode": "load_composable_node",
    "Log": "log",
    "Node": "node",
    "NodeContainer": "node_container",
    "OpaqueAction": "opaque",
    "PopEnvironment": "pop_environment",
    "PopLaunchConfigurations": "pop_launch_configurations",
    "PushEnvironment": "push_environment",
    "PushLaunchConfigurations": "push_launch_configurations",
    "PushRosNamespace": "push_ros_namespace",
    "Reset": "reset",
    "ResetEnv": "reset_env",
    "RosTimer": "ros_timer",
    "RegisterEventHandler": "register_event_handler",
    "SetEnv": "set_env",
    "SetParameter": "set_parameter",
    "SetParametersFromFile": "set_parameters_from_file",
    "SetRemap": "set_remap",
    "SetRosLogDir": "set_ros_log_dir",
    "SetUseSimTime": "set_use_sim_time",
    "Shutdown": "shutdown",
    "Timer": "timer",
    "UnregisterEventHandler": "unregister_event_handler",
    "UnsetEnv": "unset_env",
    "UnsetLet": "unset_let",
}


# Actions that others never stand in, unless they are of Python: nothing is asked there about their conditions.
_LEAVES = frozenset(
    {"Executable", "Let", "LifecycleNode", "Log", "Node", "SetEnv", "SetParameter", "SetRemap"}
)

_NOTHING: dict[str, Any] = {}  # what is known of an action of which nothing is


class Visitor(Protocol):
    """The behaviour of one action."""

    def visit(self, action: Any, run: Resolution) -> None:  # noqa: ANN401 - each visitor knows its own action
        """Carry the action out on the state of the resolution."""


def visit(actions: Iterable[Action], run: Resolution) -> None:
    """Visit actions in order, leaving out those whose condition says so."""
    run.depth += 1
    for action in actions:
        if run.steps < MOST_STEPS - 1:  # as `goes_on` counts
            run.steps += 1
        elif not run.goes_on(action):
            break
        beside = action.__pydantic_private__ or _NOTHING  # as `faults` and `origin` are told
        if "faults" in beside:
            _report_faults(action, run)
        if action.if_ is not None or action.unless is not None:
            _visit_wanted(action, run)
            continue
        origin = beside.get("origin")
        if origin is None:
            _visiting(type(action))(action, run)
            continue
        around, held = run.around, run.held
        run.around = (*around, origin)
        _visiting(type(action))(action, run)
        run.around, run.held = around, held
        run.found.carried_out[id(origin)] = origin
    run.depth -= 1


def _visit_wanted(action: Action, run: Resolution) -> None:
    """Visit an action that has a condition, unless its condition says that it is left out."""
    name, origin = type(action).__name__, action.origin
    if not wanted(action, VISITORS[name], run):
        return
    around, outer = run.around, run.held
    run.conditions += 1
    run.found.visited.add(id(action))
    if origin is not None or name not in _LEAVES:
        run.held = (*outer, *_held(action, run))
    if origin is not None:
        run.around = (*around, origin)
    _visiting(type(action))(action, run)
    if origin is not None:
        run.around = around
        run.found.carried_out[id(origin)] = origin
    run.conditions -= 1
    run.held = outer


def visit_file(description: Description, run: Resolution) -> None:
    """Visit the actions of the file that the visit is in."""
    run.found.lost |= description.lost
    run.problems.doubted |= {*description.doubted}
    if description.deprecated is not None:
        at = run.at(description.deprecated.span)
        message = f"{description.file} is deprecated: {description.deprecated.constant}"
        run.problems.warning(Code.DEPRECATED, message, at)
    visit(description.actions, run)
    if len(run.frames) == 1:
        check_late_in_file(description.actions, run)
    if description.foreign:
        from orchestra.resolve.foreign import warn_of_foreign  # noqa: PLC0415 - few files have anything of it

        warn_of_foreign(description, run)


def _report_faults(action: Action, run: Resolution) -> None:
    chain = run.context.included_from
    run.problems.extend(replace(fault, included_from=chain) for fault in action.faults)


@cache
def _visiting(kind: type[Action]) -> Callable[[Any, Resolution], None]:
    visitor: Visitor = import_module(f"orchestra.resolve.actions.{VISITORS[kind.__name__]}")
    return visitor.visit


def wanted(action: Conditional, word: str, run: Resolution) -> bool:
    """Return whether the condition of an action is true; where it is not, the action is recorded as left out."""
    template = action.if_ if action.if_ is not None else action.unless
    if template is None:
        return True
    value = run.evaluate(template)
    holds = boolean(value.text) if isinstance(value, Value) else None
    if isinstance(value, Value):
        if holds is not None and value.text not in PLAIN_CONDITIONS:
            # Here, because only what ROS 2 would refuse needs it.
            from orchestra.resolve.impossible.words import check_word  # noqa: PLC0415

            check_word(value, run, holds=holds)
        check_comparisons(template, run)
        if "equals " in template.raw and not is_python(action.span):
            from orchestra.resolve.impossible.bare_names import check_bare_names  # noqa: PLC0415 - few conditions compare

            check_bare_names(template, run)
    if holds == (action.if_ is not None):
        return True
    part = hidden(action, run.context, run.scope.variables)
    run.scope.ledger.hidden.append(part)
    if holds is not None and isinstance(value, Value):
        check_contradiction(template, run, truth=action.if_ is not None)
        _skip(action, word, template, value.text, run)
        if not run.inputs.launching and not is_python(action.span):
            # Here, because it is for checks, which have the time.
            from orchestra.resolve.unvisited import doubts  # noqa: PLC0415

            run.found.doubts.append((action, doubts(action, run)))
        return False
    if not run.inputs.launching and not is_python(action.span):
        from orchestra.resolve.unvisited import doubts  # noqa: PLC0415 - as above

        run.found.doubts.append((action, doubts(action, run, known=False)))
    if isinstance(value, Value):
        # Here, because only a faulty one needs it.
        from orchestra.resolve.impossible.words import refuse_condition  # noqa: PLC0415

        refuse_condition(template, value, run)
    run.found.lost |= words_in(action)
    run.scope.ledger.incomplete |= bool(part.files)
    return False


def _held(action: Conditional, run: Resolution) -> tuple[Held, ...]:
    """Return what the condition of an action that is carried out says."""
    template = action.if_ if action.if_ is not None else action.unless
    found = None if template is None else held(template, run, truth=action.if_ is not None)
    return () if found is None else (found,)


def _skip(action: Conditional, word: str, template: Template, value: str, run: Resolution) -> None:
    name = getattr(action, "name", None) or getattr(action, "file", None)
    run.found.skipped.append(
        ResolvedSkip(
            word,
            name.raw if name is not None else None,
            "if" if action.if_ is not None else "unless",
            template.raw,
            value,
            run.at(action.span),
        )
    )

"""Actions as calls of Python: one writer per action behind one table."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.compat.extensions import INCLUDED
from orchestra.convert.kinds import Kind, kind_of
from orchestra.convert.python.code import Bracket, Code, Element, a_list, call
from orchestra.convert.python.parts import Parts
from orchestra.convert.python.running import components, keywords
from orchestra.convert.python.values import value
from orchestra.convert.refused import why
from orchestra.convert.remarks import Remarks, UnsayableError
from orchestra.convert.tree import Notes
from orchestra.convert.words import name_of, ordered
from orchestra.dataclass import dataclass
from orchestra.description.text import Template, Words

if TYPE_CHECKING:
    from orchestra.description.actions.append_env import AppendEnv
    from orchestra.description.actions.arg import Arg
    from orchestra.description.actions.group import Group
    from orchestra.description.actions.include import Include
    from orchestra.description.actions.load_composable_node import LoadComposableNode
    from orchestra.description.actions.log import Log
    from orchestra.description.actions.reset import Reset
    from orchestra.description.actions.set_parameter import SetParameter
    from orchestra.description.actions.set_use_sim_time import SetUseSimTime
    from orchestra.description.entity import Action
    from orchestra.description.parts import Pair

Write: TypeAlias = Callable[["Writer", Any], Code]


@dataclass(frozen=True, slots=True)
class Writer:
    """Writes the actions of one file."""

    parts: Parts
    remarks: Remarks
    partial: bool = False

    def actions(self, actions: Iterable[Action]) -> Bracket:
        """Return a list of actions; what cannot be said is told, and left out or stands there as a comment."""
        found: list[Element] = []
        for action in actions:
            notes = self.parts.comments.of(action)
            try:
                found.append(Element(self._action(action), "", notes))
            except UnsayableError as error:
                self.remarks.lose(error.message, error.span)
                told = (f"not converted: {error.message}",) if self.partial else ()
                found.append(Element(None, "", Notes((*notes.before, *told), notes.beside)))
        return Bracket("[", tuple(found), "]")

    def called(
        self, name: str, action: Action, names: dict[str, str], writers: dict[str, Write] | None = None
    ) -> Code:
        """Return a call with the fields of an action that are in `names`, and its condition.

        Those without a keyword stand in front, in the order of `names`, all others as their author has them.
        """
        fields = [field for field, word in names.items() if not word]
        fields += [field for field in ordered(action) if names.get(field)]
        elements = []
        for field in fields:
            given = getattr(action, field)
            if given is not None and (given != () or field == "children"):
                code = (writers or {}).get(field, _text)(self, given)
                lead = f"{names[field]}=" if names[field] else ""
                elements.append(Element(code, lead, self.parts.comments.of(action, field)))
        return call(self.parts.texts.name(name), [*elements, *self.parts.condition(action)])

    def _action(self, action: Action) -> Code:
        name = name_of(action)
        if name is None:
            raise UnsayableError(why(action), action.span)
        return _WRITERS[name](self, action)


def _text(writer: Writer, template: Template) -> Code:
    return writer.parts.texts.of(template)


def _flag(writer: Writer, template: Template) -> Code:
    return writer.parts.flag(template)


def _fixed(writer: Writer, template: Template) -> Code:
    return writer.parts.fixed(template)


def _plain(writer: Writer, template: Template) -> Code:
    return writer.parts.plain(template)


def _pairs(writer: Writer, pairs: tuple[Pair, ...]) -> Code:
    return writer.parts.pairs(pairs)


def _children(writer: Writer, children: tuple[Action, ...]) -> Code:
    return writer.actions(children)


def _extension(writer: Writer, given: dict[str, object]) -> Code:
    return writer.parts.extension(given, Kind.TEXT)


def _simple(name: str, /, **names: str) -> Write:
    """Return a writer of an action whose values are texts; `names` are Python's words for its fields."""
    return lambda writer, action: writer.called(name, action, names)


def _running(name: str) -> Write:
    """Return a writer of an action that starts a process."""
    return lambda writer, action: call(writer.parts.texts.name(name), keywords(action, writer.parts))


def _arg(writer: Writer, action: Arg) -> Code:
    choices = [*(action.choices or ()), *(choice.value for choice in action.choice or ())]
    default = None if action.default is None else action.default.constant
    if choices and default is not None and default not in [choice.constant for choice in choices]:
        raise UnsayableError("the default is none of the choices", action.span)
    given = action.model_copy(update={"choices": tuple(choices) or None})
    names = {"name": "", "default": "default_value", "description": "description", "choices": "choices"}
    return writer.called("DeclareLaunchArgument", given, names, {"choices": _texts})


def _texts(writer: Writer, templates: tuple[Template, ...]) -> Code:
    return a_list(writer.parts.texts.of(template) for template in templates)


def _log(writer: Writer, action: Log) -> Code:
    level = "info" if action.level is None else action.level.constant
    if level is None:
        return writer.called("Log", action, {"message": "msg", "level": "level"})
    return writer.called(f"Log{level.capitalize()}", action, {"message": "msg"})


def _include(writer: Writer, action: Include) -> Code:
    texts, parts = writer.parts.texts, writer.parts
    path = (
        action.file.parts[-1].text if action.file.parts and isinstance(action.file.parts[-1], Words) else ""
    )
    kind = "Python" if path.endswith(".py") else "Any"
    source = call(texts.name(f"{kind}LaunchDescriptionSource"), [Element(texts.of(action.file))])
    elements = [Element(source, "", parts.comments.of(action, "file"))]
    if action.arg or action.let:
        elements.append(Element(_arguments(writer, (*action.arg, *action.let)), "launch_arguments="))
    for field in ordered(action):
        given = getattr(action, field)
        if field in INCLUDED and given is not None and given != ():
            code = parts.extension(given, kind_of(type(action), field))
            elements.append(Element(code, f"{field}=", parts.comments.of(action, field)))
    elements += parts.condition(action)
    return call(texts.name("IncludeLaunchDescription"), elements)


def _arguments(writer: Writer, pairs: tuple[Pair, ...]) -> Code:
    """Return arguments as a dictionary, as pairs where one is set twice."""
    names = [pair.name.constant for pair in pairs]
    if None not in names and len(set(names)) == len(names):
        found = writer.parts.pairs(pairs)
        return Bracket(found.start, found.elements, "}.items()")
    return writer.parts.paired(pairs)


def _set_parameter(writer: Writer, action: SetParameter) -> Code:
    parts = writer.parts
    name = Element(parts.texts.of(action.name), "name=", parts.comments.of(action, "name"))
    if action.value is not None:
        code: Code = value(action.value, action.type, parts.texts, quotes=False)
    else:
        dictionaries = parts.dictionaries(action.param or (), quotes=False)
        if len(dictionaries) > 1:
            raise UnsayableError("a name stands twice, which a dictionary cannot say", action.span)
        code = dictionaries[0]
    elements = [name, Element(code, "value=", parts.comments.of(action, "value")), *parts.condition(action)]
    return call(parts.texts.name("SetParameter"), elements)


def _append_env(writer: Writer, action: AppendEnv) -> Code:
    names = {"name": "", "value": "", "prepend": "prepend", "separator": "separator"}
    return writer.called("AppendEnvironmentVariable", action, names, {"prepend": _flag})


def _load(writer: Writer, action: LoadComposableNode) -> Code:
    names = {"target": "target_container", "composable_node": "composable_node_descriptions"}
    writers: dict[str, Write] = {
        "composable_node": lambda writer, given: components(writer.parts, given),
    }
    return writer.called("LoadComposableNodes", action, names, writers)


def _group(writer: Writer, action: Group) -> Code:
    names = {
        "scoped": "scoped",
        "forwarding": "forwarding",
        "keep": "launch_configurations",
        "for_each": "for_each",
        "children": "actions",
    }
    writers: dict[str, Write] = {
        "scoped": _fixed,
        "forwarding": _fixed,
        "keep": _pairs,
        "for_each": _extension,
        "children": _children,
    }
    return writer.called("GroupAction", action, names, writers)


def _timer(name: str) -> Write:
    names = {"period": "period", "cancel_on_shutdown": "cancel_on_shutdown", "children": "actions"}
    writers: dict[str, Write] = {"period": _plain, "cancel_on_shutdown": _flag, "children": _children}
    return lambda writer, action: writer.called(name, action, names, writers)


def _loop(_: Writer, action: Action) -> Code:
    """Refuse a loop: a function makes the actions in Python, which has the value itself."""
    raise UnsayableError(f"in Python `{name_of(action)}` takes a function", action.span)


def _reset(writer: Writer, action: Reset) -> Code:
    return writer.called(
        "ResetLaunchConfigurations", action, {"keep": "launch_configurations"}, {"keep": _pairs}
    )


def _set_use_sim_time(writer: Writer, action: SetUseSimTime) -> Code:
    return writer.called("SetUseSimTime", action, {"value": ""}, {"value": _flag})


_WRITERS: Final[dict[str, Write]] = {
    "append_env": _append_env,
    "arg": _arg,
    "executable": _running("ExecuteProcess"),
    "for": _loop,
    "for_each": _loop,
    "group": _group,
    "include": _include,
    "let": _simple("SetLaunchConfiguration", name="", value=""),
    "lifecycle_node": _running("LifecycleNode"),
    "load_composable_node": _load,
    "log": _log,
    "node": _running("Node"),
    "node_container": _running("ComposableNodeContainer"),
    "push_ros_namespace": _simple("PushROSNamespace", namespace=""),
    "reset": _reset,
    "reset_env": _simple("ResetEnvironment"),
    "ros_timer": _timer("RosTimer"),
    "set_env": _simple("SetEnvironmentVariable", name="", value=""),
    "set_parameter": _set_parameter,
    "set_parameters_from_file": _simple("SetParametersFromFile", filename=""),
    "set_remap": _simple("SetRemap", from_="src", to="dst"),
    "set_ros_log_dir": _simple("SetROSLogDir", new_log_dir=""),
    "set_use_sim_time": _set_use_sim_time,
    "shutdown": _simple("Shutdown", reason="reason"),
    "timer": _timer("TimerAction"),
    "unset_env": _simple("UnsetEnvironmentVariable", name=""),
}

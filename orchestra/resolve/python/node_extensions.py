"""What installed packages add to the command line of every node: entry points of the group `launch_ros.node_action`."""

from __future__ import annotations

from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch_ros.actions.node import Node
from orchestra.compat.seam import connection
from orchestra.compat.text import normalized
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.resolve.python.calling import user_code

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.actions.node import Node as NodeModel
    from orchestra.location import Span
    from orchestra.resolve.context import Value
    from orchestra.resolve.model import ResolvedProcess
    from orchestra.resolve.resolution import Resolution

GROUP: Final = "launch_ros.node_action"
_RULES: Final = {"name": "__node:=", "ns": "__ns:="}


def extended(process: ResolvedProcess, action: NodeModel, run: Resolution) -> ResolvedProcess:
    """Return a node's process with what extensions make of it: more words after `--ros-args`, other names.

    They see a `Node` of Python, whatever the node is written in.
    """
    node = action.origin if isinstance(action.origin, Node) else _node(process)
    arguments: dict[str, Any] = {
        key: f"{_RULES[key]}{value.text}"
        for key, value in (("name", process.name), ("ns", process.namespace))
        if value is not None
    }
    context = run.engine.context
    extra: list[Any] = []
    for extension in _extensions(action.span, run):
        with user_code(run, action.span):
            words, arguments = extension.prepare_for_execute(context, arguments, node)
            extra += words
    found: list[str] = []
    with user_code(run, action.span):
        context.extend_locals({"ros_specific_arguments": arguments})
        found += ["".join(sub.perform(context) for sub in normalized(word)) for word in extra]
    return replace(
        process,
        ros_arguments=(*(process.ros_arguments or ()), *found) if found else process.ros_arguments,
        name=_renamed(process.name, "name", arguments),
        namespace=_renamed(process.namespace, "ns", arguments),
        environment={},  # filled in afterwards, as all is that tells how it runs
    )


def _extensions(at: Span, run: Resolution) -> Iterator[Any]:
    """Yield an instance of each extension; one that cannot be made is left out with a warning, as upstream."""
    connection().prepare()
    for entry in entry_points(group=GROUP):
        try:
            extension = entry.load()()
        except Exception as error:  # noqa: BLE001 - code of third parties
            message = f"the extension '{entry.name}' of nodes is left out: {type(error).__name__}: {error}"
            run.problems.warning(Code.USER_CODE, message, run.at(at))
            continue
        extension.NAME = entry.name
        yield extension


def _node(process: ResolvedProcess) -> Node:
    """Return a node of Python for one that is written in another language."""
    node = Node(
        executable=process.executable,
        package=process.package,
        name=None if process.name is None else process.name.text,
        namespace=None if process.namespace is None else process.namespace.text,
        exec_name=process.label,
        arguments=list(process.arguments),
        ros_arguments=None if process.ros_arguments is None else list(process.ros_arguments),
    )
    node._resolved_as(
        None if process.name is None else process.name.text,
        None if process.namespace is None else process.namespace.text,
        [(rule.source.text, rule.target.text) for rule in process.remaps[process.remaps_among_words :]],
    )
    return node


def _renamed(value: Value | None, key: str, arguments: dict[str, Any]) -> Value | None:
    """Return a name as an extension has left it."""
    if value is None or key not in arguments:
        return value
    return replace(value, text=str(arguments[key]).removeprefix(_RULES[key]))

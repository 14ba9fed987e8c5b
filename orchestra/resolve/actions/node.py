"""`node`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.context import POISON, Evaluated, Poison, Value
from orchestra.resolve.names import node_name_fault
from orchestra.resolve.namespaces import below
from orchestra.resolve.parameters import parameters
from orchestra.resolve.programs import packaged_words, program_words
from orchestra.resolve.remapping import remap
from orchestra.resolve.running import Program, add_process, texts

if TYPE_CHECKING:
    from orchestra.description.actions.node import Node
    from orchestra.resolve.resolution import Resolution


def visit(action: Node, run: Resolution) -> None:
    """Start a node."""
    package, executable, label = (
        run.evaluate(action.pkg),
        run.evaluate(action.exec),
        run.text(action.exec_name),
    )
    words = _words(package, executable, action, run)
    name, namespace = _name(action, run), _namespace(action, run)
    if isinstance(name, Value) and isinstance(namespace, Poison):
        run.found.lost.add(name.text)  # its full name is not known
        name = POISON
    arguments, ros_arguments = texts(action.args, run), texts(action.ros_args, run)
    own, whole = parameters(action.param, run)
    rules = [remap(item.from_, item.to, run) for item in action.remap]
    values = (package, executable, label, words, name, namespace, arguments, ros_arguments)
    program = Program(
        kind="node",
        executable=executable.text if isinstance(executable, Value) else action.exec.raw,
        words=() if isinstance(words, Poison) else words,
        package=package.text if isinstance(package, Value) else None,
        name=name if isinstance(name, Value) else None,
        namespace=namespace if isinstance(namespace, Value) else None,
        label=label if isinstance(label, str) else None,
        arguments=() if isinstance(arguments, Poison) else arguments,
        ros_arguments=None if isinstance(ros_arguments, Poison) or action.ros_args is None else ros_arguments,
        parameters=(*run.scope.parameters, *own),
        remaps=(*run.scope.remaps, *(rule for rule in rules if rule is not None)),
        faulty=not whole or None in rules or any(isinstance(value, Poison) for value in values),
    )
    add_process(action, program, run)


def _words(
    package: Evaluated | None, executable: Evaluated | None, action: Node, run: Resolution
) -> tuple[str, ...] | Poison:
    if isinstance(package, Poison) or not isinstance(executable, Value):
        return POISON
    if package is None:
        return program_words(executable.text, executable.location, run)
    return packaged_words(package, executable, action, run)


def _name(action: Node, run: Resolution) -> Evaluated | None:
    value = run.evaluate(action.name)
    if value is None or isinstance(value, Poison):
        return value
    name = Value(value.text.removeprefix("/"), value.location)
    fault = node_name_fault(name.text)
    if fault is None:
        return name
    run.problems.error(
        Code.BAD_NAME, f"'{value.text}' cannot be a node's name: {fault.reason}", value.location
    )
    return POISON


def _namespace(action: Node, run: Resolution) -> Evaluated | None:
    return below(run.scope.namespace(run.at(action.span)), run.evaluate(action.namespace), run.problems)

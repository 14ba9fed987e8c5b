"""`node`."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.description.actions.node import REACHED
from orchestra.description.text import MatchedTemplate
from orchestra.errors import Code
from orchestra.resolve.context import POISON, Evaluated, Poison, Value
from orchestra.resolve.model import FileParameters, ResolvedRemap, new_process
from orchestra.resolve.namespaces import namespace_at
from orchestra.resolve.node_names import named
from orchestra.resolve.parameters import parameters
from orchestra.resolve.params_schema import params_schema
from orchestra.resolve.programs import packaged_words
from orchestra.resolve.python_programs import module_words, script_words
from orchestra.resolve.remapping import remaps
from orchestra.resolve.running import add_process
from orchestra.resolve.unpackaged import unpackaged_words
from orchestra.resolve.worded import ARGUED, texts

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.actions.node import Node
    from orchestra.description.text import Template
    from orchestra.resolve.context import Read
    from orchestra.resolve.model import Kind, ResolvedProcess
    from orchestra.resolve.resolution import Resolution

    _Started: TypeAlias = tuple[Evaluated | None, Evaluated | None, tuple[str, ...] | Poison, Sequence[Read]]


def visit(action: Node, run: Resolution) -> None:
    """Start a node; one that is brought to a state is a lifecycle node."""
    managed = None if action.lifecycle is None else run.word(action.lifecycle, REACHED)
    if managed is None:
        start(action, "node", run)
        return
    index = start(action, "lifecycle_node", run, autostart=POISON if isinstance(managed, Poison) else True)
    check_full_name(index, action, run)


def check_full_name(index: int, action: Node, run: Resolution) -> None:
    """Report a lifecycle node whose full name is not known: its state is asked for by that."""
    process = run.found.processes[index]
    if process.name is None and not process.faulty:
        place = action.lifecycle or action
        message = "a node that is brought to a state needs a `name`: it is asked by that"
        run.problems.error(Code.BAD_NAME, message, run.at(place.span))


def start(action: Node, kind: Kind, run: Resolution, *, autostart: bool | Poison | None = False) -> int:
    """Add the process of a node to what has been found; return its index."""
    package, executable, words, reads = _known(action, run) or _found(action, run)
    label = None if action.exec_name is None else run.text(action.exec_name)
    name, namespace = named(action.name, run), namespace_at(action.namespace, action, run)
    if namespace is POISON and isinstance(name, Value):
        run.found.lost.add(name.text)  # its full name is not known
        name = POISON
    given: list[FileParameters | ResolvedRemap] = []
    arguments, ros_arguments, more = _arguments(action, run, given, package, executable)
    scope = run.scope
    own, whole = parameters(action.param, run)
    rules, regular = remaps(action.remap, run)
    among = tuple([item for item in given if isinstance(item, ResolvedRemap)]) if given else ()
    schema = None if action.params_schema is None else params_schema(action.params_schema, run)
    values = (package, executable, label, words, name, namespace, arguments, ros_arguments, autostart, schema)
    process = new_process(
        kind=kind,
        executable=executable.text if isinstance(executable, Value) else _started(action).raw,
        program=() if isinstance(words, Poison) else words,
        location=action.location(run.context.included_from),
        package=package.text if isinstance(package, Value) else None,
        name=None if isinstance(name, Poison) else name,
        namespace=None if isinstance(namespace, Poison) else namespace,
        label=None if isinstance(label, Poison) else label,
        arguments=() if isinstance(arguments, Poison) else arguments,
        ros_arguments=None if isinstance(ros_arguments, Poison) or action.ros_args is None else ros_arguments,
        parameters=scope.parameters + own,
        parameter_arguments=tuple([item for item in given if isinstance(item, FileParameters)])
        if given
        else (),
        remaps=among + scope.remaps + rules,
        remaps_among_words=len(among),
        autostart=autostart is True,
        through=(*reads, *more) if more or reads else (),
        params_schema=None if isinstance(schema, Poison) else schema,
        share=run.context.packages.share(package.text) if isinstance(package, Value) else None,
        faulty=not whole or not regular or Poison in map(type, values),
    )
    if action.origin is not None:
        _tell(action.origin, process)
    if run.nodes_are_extended() and not process.faulty:
        process = _extended(process, action, run)
    return add_process(action, process, run)


def _arguments(
    action: Node,
    run: Resolution,
    given: list[FileParameters | ResolvedRemap],
    package: Evaluated | None,
    executable: Evaluated | None,
) -> tuple[tuple[str, ...] | Poison, tuple[str, ...] | Poison, Sequence[Read]]:
    """Return the arguments and the ROS arguments, and what was read for them; what they set is `given`."""
    if action.args is None and action.ros_args is None:
        return (), (), ()
    started_by = None
    if isinstance(package, Value) and package.text in ARGUED and isinstance(executable, Value):
        started_by = (package.text, executable.text)
    with run.scope.tracing() as reads:
        arguments, ros_arguments = (
            texts(action.args, run, for_ros=False, given=given, started_by=started_by),
            texts(action.ros_args, run, for_ros=True, given=given),
        )
    return arguments, ros_arguments, reads


def _tell(origin: Any, process: ResolvedProcess) -> None:  # noqa: ANN401 - any object
    """Let the object of a Python launch file know what its names have come to: user code may ask for them."""
    if not process.faulty and hasattr(origin, "_resolved_by"):
        origin._resolved_by(partial(_names, process))  # noqa: SLF001 - the class of ours that made the action


def _names(process: ResolvedProcess) -> tuple[str | None, str | None, list[tuple[str, str]]]:
    name, namespace = (None if item is None else item.text for item in (process.name, process.namespace))
    own = process.remaps[process.remaps_among_words :]
    return name, namespace, [(rule.source.text, rule.target.text) for rule in own]


def _extended(process: ResolvedProcess, action: Node, run: Resolution) -> ResolvedProcess:
    # Here, because hardly anybody has such packages, and for what it imports.
    from orchestra.resolve.python.node_extensions import extended  # noqa: PLC0415

    return extended(process, action, run)


def _started(action: Node) -> Template:
    """Return what is started: the model has one of the three."""
    started = action.module or action.script or action.exec
    assert started is not None  # noqa: S101 - see above
    return started


def _known(action: Node, run: Resolution) -> _Started | None:
    """Return what was found for a node of the same program, of which there is nothing to tell; None for none."""
    pkg, started = action.pkg, action.exec
    if type(pkg) is not MatchedTemplate or type(started) is not MatchedTemplate:
        return None
    if action.module is not None or action.script is not None:
        return None
    return run.packaged.get((pkg.constant, started.constant, run.scope.environment.get("PATH", os.defpath)))


def _found(action: Node, run: Resolution) -> _Started:
    """Return package, executable and words, and what was read for them."""
    started = _started(action)
    if started.constant is not None and (action.pkg is None or action.pkg.constant is not None):
        reads: Sequence[Read] = ()
        package, executable = run.evaluate(action.pkg), run.evaluate(started)
    else:
        with run.scope.tracing() as reads:
            package, executable = run.evaluate(action.pkg), run.evaluate(started)
    return package, executable, _words(package, executable, action, run), reads


def _words(
    package: Evaluated | None, executable: Evaluated | None, action: Node, run: Resolution
) -> tuple[str, ...] | Poison:
    if isinstance(package, Poison) or not isinstance(executable, Value):
        return POISON
    if action.module is not None:
        return module_words(executable, action, run)
    if action.script is not None:
        return script_words(executable, action.script, run)
    if package is None:
        return unpackaged_words(executable, action, run)
    program = _started(action)
    return packaged_words(package, executable, (action.pkg or program, program), run)

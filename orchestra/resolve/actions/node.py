"""`node`."""

from __future__ import annotations

import os
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.actions.node import REACHED
from orchestra.description.text import MatchedTemplate
from orchestra.errors import Code
from orchestra.resolve.context import POISON, Evaluated, Packaged, Poison, Value
from orchestra.resolve.model import FileParameters, ResolvedProcess, ResolvedRemap
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
    from orchestra.resolve.model import Kind
    from orchestra.resolve.resolution import Resolution


def visit(action: Node, run: Resolution) -> None:
    """Start a node; one that is brought to a state is a lifecycle node."""
    if action.lifecycle is None:
        start(action, "node", run)
        return
    managed = run.word(action.lifecycle, REACHED)
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
    program = _known(action, run) or _found(action, run)
    process: Any = _new(ResolvedProcess)  # what is not said of it is as the class has it
    process.kind = kind
    process.location = action.location(run.context.included_from)
    origin = process.origin = action.origin
    process.package, process.executable, process.program, process.share, process.through, faulty = program
    if process.executable is None:
        process.executable = _started(action).raw
    faulty |= _name(process, action, run)
    if action.args is not None or action.ros_args is not None:
        faulty |= _argue(process, program, action, run)
    whole = regular = True
    scope = run.scope
    among, rules = process.remaps, scope.remaps
    process.parameters = scope.parameters
    if action.param:
        own, whole = parameters(action.param, run)
        process.parameters = scope.parameters + own if scope.parameters else own
    if action.remap:
        own_rules, regular = remaps(action.remap, run)
        rules = rules + own_rules if rules else own_rules
    process.remaps = among + rules if among else rules
    if action.params_schema is not None:
        faulty |= _declare(process, action.params_schema, run)
    process.autostart = autostart is True
    process.faulty = faulty or not whole or not regular or autostart is POISON
    if origin is not None:
        _tell(origin, process)
    if run.nodes_are_extended() and not process.faulty:
        process = _extended(process, action, run)
    return add_process(action, process, run)


_new: Final = object.__new__


def _name(process: Any, action: Node, run: Resolution) -> bool:  # noqa: ANN401 - one that is filled
    """Fill in label, name and namespace; return if any is faulty."""
    label = None if action.exec_name is None else run.text(action.exec_name)
    name, namespace = named(action.name, run), namespace_at(action.namespace, action, run)
    if namespace is POISON and isinstance(name, Value):
        run.found.lost.add(name.text)  # its full name is not known
        name = POISON
    process.label = None if label is POISON else label
    process.name = None if name is POISON else name
    process.namespace = None if namespace is POISON else namespace
    return name is POISON or namespace is POISON or label is POISON


def _declare(process: Any, written: Template, run: Resolution) -> bool:  # noqa: ANN401 - as above
    """Fill in what declares the parameters; return if it is faulty."""
    schema = params_schema(written, run)
    faulty = isinstance(schema, Poison)
    process.params_schema = None if faulty else schema
    return faulty


def _argue(process: Any, program: Packaged, action: Node, run: Resolution) -> bool:  # noqa: ANN401 - as above
    """Fill in the arguments, and what they set; return if any is faulty."""
    started_by = None
    if program.package in ARGUED and program.executable is not None:
        started_by = (program.package, program.executable)
    given: list[FileParameters | ResolvedRemap] = []
    with run.scope.tracing() as reads:
        arguments, ros_arguments = (
            texts(action.args, run, for_ros=False, given=given, started_by=started_by),
            texts(action.ros_args, run, for_ros=True, given=given),
        )
    faulty = isinstance(arguments, Poison) or isinstance(ros_arguments, Poison)
    process.arguments = () if isinstance(arguments, Poison) else arguments
    if action.ros_args is not None:
        process.ros_arguments = None if isinstance(ros_arguments, Poison) else ros_arguments
    if given:
        process.remaps = tuple([item for item in given if isinstance(item, ResolvedRemap)])
        process.remaps_among_words = len(process.remaps)
        process.parameter_arguments = tuple([item for item in given if isinstance(item, FileParameters)])
    if reads:
        process.through = (*program.through, *reads)
    return faulty


def _tell(origin: Any, process: ResolvedProcess) -> None:  # noqa: ANN401 - any object
    """Let the object of a Python launch file know what its names have come to: user code may ask for them."""
    take = getattr(type(origin), "_resolved_by", None)  # of the class of ours that made the action
    if take is not None and not process.faulty:
        take(origin, partial(_names, process))


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


def _known(action: Node, run: Resolution) -> Packaged | None:
    """Return what was found for a node of the same program, of which there is nothing to tell; None for none."""
    pkg, started = action.pkg, action.exec
    if type(pkg) is not MatchedTemplate or type(started) is not MatchedTemplate:
        return None
    if action.module is not None or action.script is not None:
        return None
    return run.packaged.get((pkg.constant, started.constant, run.scope.environment.get("PATH", os.defpath)))


def _found(action: Node, run: Resolution) -> Packaged:
    """Return package, executable and words, and what was read for them."""
    started = _started(action)
    if started.constant is not None and (action.pkg is None or action.pkg.constant is not None):
        reads: Sequence[Read] = ()
        package, executable = run.evaluate(action.pkg), run.evaluate(started)
    else:
        with run.scope.tracing() as reads:
            package, executable = run.evaluate(action.pkg), run.evaluate(started)
    words = _words(package, executable, action, run)
    name = package.text if isinstance(package, Value) else None
    return Packaged(
        name,
        executable.text if isinstance(executable, Value) else None,
        () if isinstance(words, Poison) else words,
        None if name is None else run.context.packages.share(name),
        tuple(reads),
        package is POISON or executable is POISON or words is POISON,
    )


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

"""The exact command line of a process, in upstream's order."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.model import ResolvedProcess


def command(
    process: ResolvedProcess, parameter_file: str | None, rules: Sequence[tuple[str, str]]
) -> tuple[str, ...]:
    """Return the argv of a process: prefix, program, its arguments, and for a node what rcl reads.

    The order is upstream's (`launch_ros`, Node): arguments, `ros_arguments`, name, namespace, parameters,
    remappings (`rules`), those of the scope before the node's own.
    """
    name, namespace, given = process.name, process.namespace, process.ros_arguments
    words = [*process.prefix, *process.program, *process.arguments]
    if process.kind == "process":
        return tuple(words)
    if given is not None:
        words += "--ros-args", *given
    words.append("--ros-args")
    if name is not None:
        words += "-r", f"__node:={name.text}"
    if namespace is not None:
        words += "-r", f"__ns:={namespace.text}"
    if parameter_file is not None:
        words += "--params-file", parameter_file
    if rules:
        for rule in map(":=".join, rules[process.remaps_among_words :]):
            words += "-r", rule
    return tuple(words)

"""The exact command line of a process, in upstream's order."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.resolve.model import ResolvedProcess


def command(process: ResolvedProcess, parameter_file: str | None) -> tuple[str, ...]:
    """Return the argv of a process: prefix, program, its arguments, and for a node what rcl reads.

    The order is upstream's (`launch_ros`, Node): arguments, `ros_arguments`, name, namespace, parameters,
    remappings, those of the scope before the node's own.
    """
    words = [*process.prefix, *process.program, *process.arguments]
    if process.kind == "process":
        return tuple(words)
    if process.ros_arguments is not None:
        words += ["--ros-args", *process.ros_arguments]
    words.append("--ros-args")
    if process.name is not None:
        words += ["-r", f"__node:={process.name.text}"]
    if process.namespace is not None:
        words += ["-r", f"__ns:={process.namespace.text}"]
    if parameter_file is not None:
        words += ["--params-file", parameter_file]
    for rule in process.remaps[process.remaps_among_words :]:
        words += ["-r", f"{rule.source.text}:={rule.target.text}"]
    return tuple(words)

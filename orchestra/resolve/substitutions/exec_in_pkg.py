"""`$(exec-in-pkg executable package)`: the path of a package's executable."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code
from orchestra.resolve.context import POISON
from orchestra.resolve.refusals import refuse, report_missing_executable, report_missing_package
from orchestra.resolve.substitutions.arguments import made, span_of_arguments, texts

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated, Poison
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the path; an executable that only a command of several words starts has none."""
    words = texts(call, context, evaluate)
    if words is None:
        return POISON
    executable, package = words
    written, written_package = call.arguments
    if context.packages.prefix(package) is None:
        if package in context.packages.executables(executable):
            return _refuse_swapped(call, executable, context)
        return report_missing_package(package, written_package, context)
    match context.packages.executable(package, executable):
        case None:
            # Here, because most executables are there.
            from orchestra.resolve.lacking import is_another  # noqa: PLC0415

            if is_another(package, context.packages, context.file):
                return report_missing_package(package, written_package, context)
            return report_missing_executable(executable, package, written, context)
        case (path,):
            return made(call, context, path)
        case command:
            told = (
                f"executable {executable!r} of package {package!r} is started by several words, not by a path"
            )
            notes = (f"they are {' '.join(command)}", "a node action can start it")
            return refuse(written, context, Code.MISSING_EXECUTABLE, told, notes=notes)


def _refuse_swapped(call: Call, package: str, context: Context) -> Poison:
    """Report a package that stands before its executable, as it does everywhere else."""
    first, last = call.arguments
    told = f"{package!r} is a package: its executable stands before it here"
    instead = None if first.quoted or last.quoted else f"{last.raw} {first.raw}"
    at = context.at(span_of_arguments(call))
    context.problems.error(Code.MISSING_PACKAGE, told, at, suggestion=instead)
    return POISON

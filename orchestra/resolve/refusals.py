"""Reports what a written text turned out to name and is not there."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.description.source import shortened
from orchestra.errors import HERE, Code, Severity
from orchestra.location import displayed, is_file, is_python
from orchestra.nearest import is_one_slip, is_slip, nearest
from orchestra.resolve.command_line import COMMAND_LINE
from orchestra.resolve.context import POISON

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from orchestra.description.text import Template
    from orchestra.errors import Problems
    from orchestra.location import Location, Span
    from orchestra.resolve.context import Context, Poison, Read, Value


_UNSET = (Code.UNDEFINED_VARIABLE, Code.UNSET_ENVIRONMENT)
_OF_ROS_1 = {"rviz": "rviz2", "tf": "tf2_ros"}  # packages that only ROS 1 has, with what does their work
_NAMED = ("variable", "environment", "parameter")


def refuse(
    written: Template,
    context: Context,
    code: Code,
    told: str,
    *,
    meant: str | None = None,
    notes: Iterable[str] = (),
) -> Poison:
    """Report an error at a written text. What was meant can replace it only where it holds no substitution.

    What something faulty would have set is not reported to be unset.
    """
    if code in _UNSET and written.constant in context.lost:
        return POISON
    replaceable = written.constant is not None
    if meant is not None and not replaceable:
        notes = (*notes, f"did you mean {meant!r}?")
    suggestion = meant if replaceable else None
    context.problems.error(code, told, context.at(written.span), suggestion=suggestion, notes=notes)
    return POISON


def refuse_value(
    value: Value,
    problems: Problems,
    code: Code,
    told: str,
    *,
    meant: str | None = None,
    notes: Iterable[str] = (),
) -> Poison:
    """Report an error at a value, with what was meant where that is known.

    A value that came through variables is hardly anything but a slip where something near it was meant: then the place
    is that where it was written; else that where it is used, with a note where it was set.
    """
    origin = value.location if value.verbatim else written_at(value) or set_by_code(value)
    if meant is not None and origin is not None:
        used = () if value.verbatim else (f"it is used at {value.location}",)
        forget_surprise(origin.span, problems)
        problems.error(code, told, origin, suggestion=meant, notes=(*notes, *used))
        return POISON
    if meant is not None and not value.verbatim:
        notes = (*notes, f"did you mean '{meant}'?")
    suggestion = meant if value.verbatim else None
    notes = (*notes, *_sources(value.through))
    problems.error(code, told, value.location, suggestion=suggestion, notes=notes)
    return POISON


def written_at(value: Value) -> Location | None:
    """Return where a value was written that came through variables as it is, None where it was made of parts."""
    reads = value.through
    while len(reads) == 1 and reads[0].kind == "variable" and reads[0].value == value.text:
        if reads[0].written is not None:
            return reads[0].written
        reads = reads[0].through
    return None


def made_at(value: Value) -> Location | None:
    """Return where a value that came through variables as it is was written, or put together of parts."""
    reads, found = value.through, None
    while len(reads) == 1 and reads[0].kind == "variable" and reads[0].value == value.text:
        if (
            reads[0].source is None
            or reads[0].location is None
            or reads[0].location.span.file == COMMAND_LINE
        ):
            return None
        found, reads = reads[0].source.location, reads[0].through
    return found


def forget_surprise(at: Span, problems: Problems) -> None:
    """Take back the warning that a value is surprising, or seems to lack a '$', where it is told to be wrong."""
    problems.take_back(Code.SURPRISING_SCALAR, at)
    problems.take_back(Code.SUBSTITUTION_SYNTAX, at)


def set_by_code(value: Value) -> Location | None:
    """Return where code in Python sets the one variable that a value is; what is wrong is found in that code."""
    reads, found = value.through, None
    while len(reads) == 1 and reads[0].kind == "variable" and reads[0].value == value.text:
        found, reads = reads[0].location, reads[0].through
    return found if found is not None and is_python(found) else None


def _sources(through: Iterable[Read]) -> Iterator[str]:
    """Yield where what a value was made of was set, outermost first."""
    for read in through:
        if read.location is not None and read.kind in _NAMED:
            yield f"'{read.name}' is set to '{shortened(read.value)}' at {read.location}"
        yield from _sources(read.through)


def report_missing_package(
    package: str, written: Template, context: Context, value: Value | None = None
) -> Poison:
    """Report a package that is not here; `written` is the text that names it, `value` what it comes to.

    Where nothing will be started it may be elsewhere: then it is told once, and no error, unless the name is a slip for
    one that is installed.
    """
    if "/" in package:
        told = f"{package!r} is no name of a package: a path in one is written behind it"
        return refuse(written, context, Code.MISSING_PACKAGE, told)
    missing = missing_package(package, context.packages.names(), context.weights.package)
    if missing.severity is not Severity.ERROR:
        if package not in context.elsewhere:
            told = f"{missing.told}: what it would give is left open"
            at = context.at(written.span)
            context.problems.weighed(missing.severity, Code.MISSING_PACKAGE, told, at)
        context.elsewhere.add(package)
        return POISON
    if value is not None:
        return refuse_value(value, context.problems, Code.MISSING_PACKAGE, missing.told, meant=missing.meant)
    return refuse(written, context, Code.MISSING_PACKAGE, missing.told, meant=missing.meant)


@dataclass(frozen=True, slots=True)
class Missing:
    """What is to be said of a package or a variable that is not here, and the name that was meant."""

    severity: Severity
    told: str
    meant: str | None


@lru_cache(maxsize=64)  # many nodes are of one package
def missing_package(package: str, known: tuple[str, ...], weight: Severity) -> Missing:
    """Return what is to be said of a package that is none of those that are known, of such a weight."""
    if not package.strip():
        return Missing(Severity.ERROR, "the name of a package is missing", None)
    successor = _OF_ROS_1.get(package)
    if successor in known:
        return Missing(Severity.ERROR, f"there is no package {package!r} here", successor)
    meant = nearest(package, known)
    if weight is Severity.ERROR or (meant is not None and _is_slip_in_words(package, meant)):
        return Missing(Severity.ERROR, f"there is no package {package!r} here", meant)
    return Missing(weight, f"there is no package {package!r} {HERE}", None)


def report_unset_environment(name: str, written: Template, context: Context) -> Poison:
    """Report an environment variable that is not set; `written` is the text that names it.

    Where no plan is made it may be set elsewhere: then it is told once, and no error, unless the name is a slip for one
    that is set, or the description itself has removed it.
    """
    weight = Severity.ERROR if context.variables.removes(name) else context.weights.variable
    unset = unset_environment(name, context.environment, weight)
    if unset.severity is Severity.ERROR:
        return refuse(written, context, Code.UNSET_ENVIRONMENT, unset.told, meant=unset.meant)
    if f"environment {name}" not in context.elsewhere and name not in context.lost:
        told = f"{unset.told}: what it would give is left open"
        context.problems.weighed(unset.severity, Code.UNSET_ENVIRONMENT, told, context.at(written.span))
    context.elsewhere.add(f"environment {name}")
    return POISON


def unset_environment(name: str, known: Iterable[str], weight: Severity) -> Missing:
    """Return what is to be said of an environment variable that is none of those that are known, of such a weight."""
    meant = nearest(name, known)
    if weight is Severity.ERROR or (meant is not None and _is_slip_in_words(name, meant)):
        return Missing(Severity.ERROR, f"the environment variable {name!r} is not set", meant)
    return Missing(weight, f"the environment variable {name!r} is not set {HERE}", None)


def _is_slip_in_words(name: str, meant: str) -> bool:
    """Return whether a name is hardly anything but a slip in the words of another.

    `ROBOT_NAME` is none of `ROBOT_TYPE`, nor `joint_state_publisher` of `robot_state_publisher`, nor `utils` of
    `rcutils`.
    """
    words, others = name.split("_"), meant.split("_")
    if len(words) != len(others):
        return is_one_slip(name, meant)
    return all(
        word == other or (is_slip(word, other) and (word[:1] == other[:1] or is_one_slip(word, other)))
        for word, other in zip(words, others, strict=True)
    )


def report_missing_executable(
    executable: str, package: str, written: Template, context: Context, value: Value | None = None
) -> Poison:
    """Report an executable that a package lacks; `written` is the text that names it, `value` what it comes to."""
    known = context.packages.executables(package)
    idle = Path(context.packages.prefix(package) or "", "lib", package, executable)
    if is_file(idle):
        told = f"{displayed(str(idle))} is not executable"
        return refuse(written, context, Code.MISSING_EXECUTABLE, told, notes=("`chmod +x` makes it so",))
    notes = (f"it has {', '.join(sorted(known))}",) if known else ("it has no executables",)
    told = f"package {package!r} has no executable {executable!r}"
    name, first = executable.rpartition("/")[2], executable.partition(" ")[0]
    if first != executable and first in known:
        told += ": what follows the first word belongs into args"
        name = first
    meant = name if name in known else nearest(executable, known)
    if meant is None or not is_slip(executable, meant):
        elsewhere = _had_by(executable, context)
        told += elsewhere
        meant = None if elsewhere else meant
    if value is not None:
        return refuse_value(value, context.problems, Code.MISSING_EXECUTABLE, told, meant=meant, notes=notes)
    return refuse(written, context, Code.MISSING_EXECUTABLE, told, meant=meant, notes=notes)


def _had_by(executable: str, context: Context) -> str:
    """Return that another package has an executable of such a name, nothing where none or several have it."""
    found = [
        package
        for package in context.packages.names()
        if executable and is_file(Path(context.packages.prefix(package) or "", "lib", package, executable))
    ]
    return f": '{found[0]}' has it" if len(found) == 1 else ""

"""One node without a launch file (`orchestra run`): its arguments are passed on as they are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.errors import Code, Problems
from orchestra.location import Location, Span
from orchestra.nearest import nearest
from orchestra.resolve.command_line import COMMAND_LINE
from orchestra.resolve.containers import container_words
from orchestra.resolve.model import Resolved, ResolvedProcess

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.context import Packages


def single_node(
    package: str,
    executable: str,
    arguments: Sequence[str],
    prefix: str,
    problems: Problems,
    packages: Packages,
) -> Resolved:
    """Return what `run PACKAGE EXECUTABLE ARGUMENTS` comes to: one process whose end ends the run, with its status."""
    at = Span(COMMAND_LINE, 1, 1, 1, len(package) + 1)
    location = Location(at)
    words = container_words(package, executable, packages) or packages.executable(package, executable)
    if words is None:
        _report(package, executable, at, problems, packages)
    process = ResolvedProcess(
        kind="process",
        package=package,
        executable=executable,
        name=None,
        namespace=None,
        label=None,
        program=words or (),
        arguments=tuple(arguments),
        ros_arguments=None,
        prefix=_words(prefix),
        shell=False,
        cwd=None,
        environment={},
        parameters=(),
        remaps=(),
        output=None,
        emulate_tty=None,
        restart=None,
        required=True,
        shutdown_on_exit=False,
        success_exit_codes=None,
        ready=None,
        alive=None,
        stop=None,
        depends_on=(),
        labels=(),
        location=location,
        conditional=False,
        faulty=words is None,
    )
    return Resolved(COMMAND_LINE, (), (process,), (), (), ())


def _report(package: str, executable: str, at: Span, problems: Problems, packages: Packages) -> None:
    if packages.prefix(package) is None:
        suggestion = nearest(package, packages.names())
        problems.error(
            Code.MISSING_PACKAGE, f"there is no package '{package}' here", at, suggestion=suggestion
        )
        return
    known = packages.executables(package)
    span = Span(COMMAND_LINE, 1, at.end_column + 1, 1, at.end_column + 1 + len(executable))
    problems.error(
        Code.MISSING_EXECUTABLE,
        f"package '{package}' has no executable '{executable}'",
        span,
        suggestion=nearest(executable, known),
        notes=("it has " + ", ".join(sorted(known)),) if known else (),
    )


def _words(prefix: str) -> tuple[str, ...]:
    import shlex  # noqa: PLC0415 - slow, and few nodes have a prefix

    return tuple(shlex.split(prefix))

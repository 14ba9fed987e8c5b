"""Parameter files of a description, as rcl reads them."""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.description.source import shortened
from orchestra.description.substitutions import SIGNATURES
from orchestra.errors import Code, Problems, Severity
from orchestra.fields import replace
from orchestra.load.encodings import UndecodableError, decoded
from orchestra.location import Location, displayed, point
from orchestra.patterns import pattern
from orchestra.resolve.context import Value
from orchestra.resolve.model import FileParameters
from orchestra.resolve.near_paths import near_path
from orchestra.resolve.paths import beside, existing_file, folder_of
from orchestra.resolve.plain_parameters import given, named_by
from orchestra.resolve.rcl.files import read_kept, read_plain_file
from orchestra.resolve.rcl.sections import included
from orchestra.resolve.rcl.straight import sections_of
from orchestra.resolve.rcl.strays import SECTION_KEY
from orchestra.resolve.substituted import Back, Reads, placed_back, substituted
from orchestra.witness.once import once, real

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.errors import Problem
    from orchestra.location import Span
    from orchestra.resolve.rcl.sections import Section
    from orchestra.resolve.resolution import Resolution

_CALL: Final = pattern(r"[^$]*\$\(([a-z][a-z-]*)[ )]")


def file_parameters(
    written: Template,
    run: Resolution,
    *,
    substitute: bool = False,
    everywhere: bool = False,
    plain: bool = False,
) -> FileParameters | None:
    """Return what a parameter file holds, None where it cannot be found or read (which has been reported).

    With `substitute`, `$(...)` in it is evaluated; with `plain`, it may be one without sections: components have those.
    Nodes are started without a file that somebody else was to put there.
    """
    value = run.evaluate(written)
    if not isinstance(value, Value):
        return None
    asked = (value.text if value.text.startswith("/") else _from_here(value.text, run)), plain
    known = None if substitute else run.parameter_files.get(asked)
    if known is not None:  # many nodes are given the same file
        _keep(known, value, written, run, plain=plain)
        return given(known, value, everywhere=everywhere)
    path = beside(run.context.file, value.text) if value.text else None
    if value.text.startswith("~/"):
        path = existing_file(value, written, "parameter file", run)
        if path is None:
            return FileParameters("", (), value.location)
    if path is None:
        needed = substitute or everywhere or plain
        lacking = None if needed and (run.context.launching or not value.text) else _lacking(value, run)
        if lacking is not None and "\\" not in written.raw:
            _warn_of_lacking(lacking, value, written, run)
            return FileParameters("", (), value.location)
        path = existing_file(value, written, "parameter file", run)
    if path is None:
        return None
    if substitute:
        file = read_file(path, value.location, run, substitute=True, plain=plain)
    else:
        if (path, plain) not in run.parameter_files:
            run.parameter_files[path, plain] = read_file(path, value.location, run, plain=plain)
        file = run.parameter_files[asked] = run.parameter_files[path, plain]
    return None if file is None else given(file, value, everywhere=everywhere)


def _keep(file: FileParameters, value: Value, written: Template, run: Resolution, *, plain: bool) -> None:
    """Have the file found at once where the same text names it again."""
    named = named_by(written, run, plain=plain) if value.text.startswith("/") else None
    if named is not None:
        run.parameter_files[named[0]] = file


def _from_here(path: str, run: Resolution) -> str:
    """Return a path with what else decides where it leads."""
    return "\0".join((run.context.file or "", path, os.getcwd()))  # noqa: PTH109 - pathlib is slow


def _warn_of_lacking(told: str, value: Value, written: Template, run: Resolution) -> None:
    """Tell that a node is started without a file, but for an argument that is empty because the file is optional.

    Where nothing is started it is only told if another file was probably meant: this may be another machine.
    """
    if not value.text and not value.verbatim:
        return
    near = near_path(Path.cwd() / value.text, written.raw) if value.text else None
    if run.context.launching or near is not None or not value.text:
        meant = near if near is not None and near != written.raw else None
        run.problems.warning(Code.MISSING_FILE, told, value.location, suggestion=meant)


def _lacking(value: Value, run: Resolution) -> str | None:
    """Return what is to be told of a file that is not there and that the node can do without, None if it must be.

    Upstream warns of every file that is not there, and of an empty path, which is how an argument makes one optional. A
    file neither beside the launch file nor where packages are is of the machine (`/etc/robot/control.yaml`), and may
    come later. All others are mistakes.
    """
    if not value.text:
        return "the path of the parameter file is empty"
    folder = folder_of(run.context.file)
    path = os.path.normpath(os.path.join(folder, os.path.expanduser(value.text)))  # noqa: PTH111, PTH118 - no `~x` fails
    prefixes = run.scope.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    places = (folder, *(Path(prefix) for prefix in prefixes if prefix))
    if any(Path(path).is_relative_to(place) for place in places):
        return None
    return f"there is no parameter file {displayed(path)}: the node is started without it"


def read_file(
    path: str, location: Location, run: Resolution, *, substitute: bool = False, plain: bool = False
) -> FileParameters | None:
    """Return the sections of a parameter file, None where it cannot be read (which has been reported).

    Where nothing but values is wrong, the others are looked at all the same: mistakes do not hide each other.

    With `substitute`, `$(...)` in it is evaluated; with `plain`, it may be one without sections.
    """
    chain = (location.span, *location.included_from)
    text = _text(path, location, chain, run)
    if text is None:
        return None
    file = once(("displayed", path, os.getcwd()), lambda: displayed(path, real))  # noqa: PTH109 - pathlib is slow
    back: Back | None = None
    reads: Reads = ()
    if substitute:
        known = substituted(text, file, replace(run.context, included_from=chain))
        if known is None:
            return None
        text, back, reads = known
    bare = plain and SECTION_KEY not in text
    sections, whole, found = (
        _read(text, file, bare=bare) if back is None else _read_back(text, file, back, bare=bare)
    )
    if not sections and _is_refused(path, text, location, run):
        return None
    for problem in found:
        run.problems.report(replace(problem, included_from=(*problem.included_from, *chain)))
    sound = all(problem.severity is not Severity.ERROR for problem in found)
    if not sound and not (whole and sections):
        return None
    sections = tuple(included(section, chain) for section in sections)
    if not substitute and "$(" in text:
        _warn_of_kept(sections, location, run)
    if bare:
        return FileParameters(
            path, (), location, plain=tuple(item for part in sections for item in part.entries), within=reads
        )
    return FileParameters(path, sections, location, within=reads, sound=sound)


def sections_in(path: str) -> tuple[Section, ...]:
    """Return the sections of a file that a program reads by itself; none where it cannot be read. Nothing is told."""
    try:
        text = once(("parameters", path), lambda: decoded(_content(path)))
    except (OSError, UndecodableError):
        return ()
    return _read(text, path, bare=False)[0]


def _warn_of_kept(sections: tuple[Section, ...], given_at: Location, run: Resolution) -> None:
    """Tell of the first substitution that stays a text, because those of the file are not asked for."""
    for entry in (entry for section in sections for entry in section.entries):
        found = _CALL.match(entry.value) if isinstance(entry.value, str) else None
        if found is not None and found[1] in SIGNATURES:
            message = (
                f"'{shortened(str(entry.value))}' stays a text: the file is given without `allow_substs`"
            )
            notes = (f"`allow_substs: true` where it is given, at {given_at}, evaluates it",)
            run.problems.warning(Code.SURPRISING_SCALAR, message, entry.location, notes=notes)
            return


@lru_cache(maxsize=64)  # by content: many nodes and files have the same one
def _read(text: str, file: str, *, bare: bool) -> tuple[tuple[Section, ...], bool, tuple[Problem, ...]]:
    """Return what a file holds, whether all sections are there, and what is wrong; as if no include had led to it."""
    found = Problems()
    if bare:
        return read_plain_file(text, file, found), not len(found), tuple(found)
    plain = sections_of(text, file)
    if plain is not None:
        return plain, True, ()
    return *read_kept(text, file, found), tuple(found)


@lru_cache(maxsize=64)  # as above
def _read_back(
    text: str, file: str, back: Back, *, bare: bool
) -> tuple[tuple[Section, ...], bool, tuple[Problem, ...]]:
    """Return the same of a text with the values of substitutions, with its places in the file itself."""
    sections, whole, found = _read(text, file, bare=bare)
    problems = [item if item.span is None else replace(item, span=back(item.span)) for item in found]
    return tuple([placed_back(section, back) for section in sections]), whole, tuple(problems)


def _text(path: str, location: Location, chain: tuple[Span, ...], run: Resolution) -> str | None:
    try:
        return once(("parameters", path), lambda: decoded(_content(path)))
    except OSError as error:
        message = f"cannot read the parameter file {displayed(path)}: {error}"
        run.problems.error(Code.UNREADABLE_FILE, message, location)
    except UndecodableError as error:
        at = Location(point(displayed(path, real), error.line, error.column), chain)
        run.problems.error(Code.PARAMETER_SYNTAX, str(error), at)
    return None


def _content(path: str) -> bytes:
    with open(path, "rb", buffering=0) as file:  # noqa: PTH123 - pathlib is slow
        return file.read()


def _is_refused(path: str, text: str, location: Location, run: Resolution) -> bool:
    """See `refused_as_parameters`, which only a file without parameters needs."""
    from orchestra.resolve.other_kinds import refused_as_parameters  # noqa: PLC0415

    return refused_as_parameters(path, text, location, run)

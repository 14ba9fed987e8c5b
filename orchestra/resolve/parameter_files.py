"""Parameter files of a description, as rcl reads them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code, Problems
from orchestra.location import displayed
from orchestra.resolve.context import Value
from orchestra.resolve.model import FileParameters
from orchestra.resolve.paths import existing_file
from orchestra.resolve.rcl.files import read_parameter_file, read_plain_file
from orchestra.resolve.rcl.reader import SECTION_KEY
from orchestra.resolve.substituted import Back, placed_back, substituted

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution


def file_parameters(
    written: Template,
    run: Resolution,
    *,
    substitute: bool = False,
    everywhere: bool = False,
    plain: bool = False,
) -> FileParameters | None:
    """Return what a parameter file holds, None where it cannot be found or read (which has been reported).

    With `substitute`, `$(...)` in it is evaluated; with `plain`, it may be one without sections. An empty path is no
    file: how files make one optional, with an argument whose default is empty.
    """
    value = run.evaluate(written)
    if not isinstance(value, Value):
        return None
    if not value.text:
        run.problems.warning(Code.MISSING_FILE, "the path of the parameter file is empty", value.location)
        return FileParameters("", (), value.location, everywhere=everywhere)
    path = existing_file(value, written, "parameter file", run)
    if path is None:
        return None
    if substitute:
        file = read_file(path, value.location, run, substitute=True, plain=plain)
    else:
        if (path, plain) not in run.parameter_files:
            run.parameter_files[path, plain] = read_file(path, value.location, run, plain=plain)
        file = run.parameter_files[path, plain]
    return None if file is None else replace(file, location=value.location, everywhere=everywhere)


def read_file(
    path: str, location: Location, run: Resolution, *, substitute: bool = False, plain: bool = False
) -> FileParameters | None:
    """Return the sections of a parameter file, None where it cannot be read (which has been reported).

    With `substitute`, `$(...)` in it is evaluated; with `plain`, it may be one without sections.
    """
    text = _text(path, location, run)
    if text is None:
        return None
    file, chain = displayed(path), (location.span, *location.included_from)
    back: Back | None = None
    if substitute:
        evaluated = substituted(text, file, replace(run.context, included_from=chain))
        if evaluated is None:
            return None
        text, back = evaluated
    found = Problems()
    bare = plain and SECTION_KEY not in text
    sections = (read_plain_file if bare else read_parameter_file)(text, file, found, chain)
    for problem in found:
        span = back(problem.span) if back is not None and problem.span is not None else problem.span
        run.problems.report(replace(problem, span=span))
    if found.errors:
        return None
    if back is not None:
        sections = tuple(placed_back(section, back) for section in sections)
    if bare:
        return FileParameters(
            path, (), location, plain=tuple(item for part in sections for item in part.entries)
        )
    return FileParameters(path, sections, location)


def _text(path: str, location: Location, run: Resolution) -> str | None:
    try:
        return Path(path).read_bytes().decode("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        message = f"cannot read the parameter file {displayed(path)}: {error}"
        run.problems.error(Code.UNREADABLE_FILE, message, location)
        return None

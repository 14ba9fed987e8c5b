"""`interface build`: packages of definitions made ready to use. No rclpy."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import Code, DescriptionError, Problem, RunError, Severity, UsageError
from orchestra.location import Span
from orchestra.resolve.interfaces import prefixes, sources
from orchestra.ros.interfaces.building.build import Builder, MistakesError
from orchestra.ros.interfaces.reading.mistakes import DefinitionError
from orchestra.ros.tools.telling import tell

if TYPE_CHECKING:
    from argparse import Namespace

    from orchestra.resolve.interfaces.sources import Source
    from orchestra.ros.interfaces.building.build import Built


def build(options: Namespace) -> int:
    """Build the packages at some paths, with those that they need."""
    wanted = [source for path in options.paths for source in _at(Path(path))]
    cache = prefixes.this_cache(os.environ, compiles=False if options.without_compiler else None)
    if cache is None:
        raise RunError("there is no folder for what is built: set ORCHESTRA_CACHE or HOME")
    around = [sources.found_in(sources.places(source.folder, os.environ)) for source in wanted]
    known = {name: source for found in reversed(around) for name, source in found.items()}
    known |= {source.name: source for source in wanted}
    builder = Builder(known, cache, os.environ, lambda line: print(line, file=sys.stderr, flush=True))  # noqa: T201 - how far it is
    found: list[DefinitionError] = []
    for source in wanted:
        try:
            builder.check(source) if options.only_check else builder.build(source)
        except MistakesError as error:
            found.extend(error.found)
        except DefinitionError as error:
            found.append(error)
    if found:
        raise DescriptionError(tuple(dict.fromkeys(map(problem_of, found))))
    if options.only_check:
        return 0
    told = [_told(built) for built in builder.built]
    tell(options, "".join(f"{line}\n" for line in map(_line, told)), told)
    return 0


def problem_of(error: DefinitionError) -> Problem:
    """Return the problem that a mistake in a definition is."""
    line, column, end = error.place or (1, 1, 1)
    return Problem(
        Code.BAD_DEFINITION, Severity.ERROR, error.message, Span(error.file, line, column, line, end)
    )


def _at(path: Path) -> list[Source]:
    """Return the packages of definitions that a folder is or has in it."""
    if not path.is_dir():
        raise UsageError(f"there is no folder {path}")
    source = sources.in_folder(path)
    if source is not None:
        return [source]
    found = sources.found_in(((path, 12),))
    if not found:
        raise UsageError(f"there is no package with msg, srv or action definitions in {path}")
    return list(found.values())


def _told(built: Built) -> dict[str, object]:
    return {
        "package": built.source.name,
        "definitions": len(built.source.files),
        "compiled": built.compiled,
        "seconds": built.seconds,
        "prefix": str(built.prefix),
    }


def _line(told: dict[str, object]) -> str:
    how = "compiled" if told["compiled"] else "used without a compiler, which is slower"
    seconds = told["seconds"]
    when = f", in {seconds:.1f} s" if isinstance(seconds, float) else ", as before"
    return f"{told['package']}: {how}{when}"

"""Makes packages of definitions importable that nobody has installed: for tools that are told the name of a type."""

from __future__ import annotations

import os
import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.resolve.interfaces import prefixes, sources
from orchestra.resolve.interfaces.available import available
from orchestra.ros.interfaces import definitions

if TYPE_CHECKING:
    from orchestra.resolve.interfaces.sources import Source


def make_importable(package: str) -> None:
    """Let a package be imported, with those that it needs, if its definitions can be found.

    What is compiled already is used as it is; else the definitions are used as they are now.
    """
    if not definitions.is_here(package):
        _take(package)


@cache
def known() -> dict[str, Source]:
    """Return the packages that can be made importable, as seen from the working directory."""
    return available(Path.cwd(), os.environ)


def _take(package: str) -> None:
    source = known().get(package)
    if source is None:
        return
    where = prefixes.this_cache(os.environ)
    prefix = None if where is None else prefixes.prefix_of(source, known(), where)
    if prefix is not None and prefix.is_dir() and prefixes.record(prefix)["compiled"]:
        sys.path.append(str(prefixes.python_folder(prefix)))
    else:
        definitions.install(package, source.folder)
    for other in sources.mentioned(source):
        make_importable(other)

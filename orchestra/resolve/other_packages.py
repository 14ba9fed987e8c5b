"""Files that a package does not have, and another one has at the same place."""

from __future__ import annotations

import re
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.location import is_file
from orchestra.resolve.packages.ament import packages, prefixes

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from orchestra.resolve.resolution import Resolution


def of_other_package(path: str, written: str, run: Resolution) -> str | None:
    """Return how a path that is not there is written with the one package that has the file; None without such.

    Of several packages it is the one that the launch file names.
    """
    for prefix in prefixes(run.scope.environment):
        share = Path(prefix, "share")
        if not Path(path).is_relative_to(share):
            continue
        package, _, below = str(Path(path).relative_to(share)).partition("/")
        named = re.compile(rf"(\$\(\s*find-pkg-share\s+['\"]?){re.escape(package)}(?=['\"]?\s*\))")
        if not below or len(named.findall(written)) != 1:
            return None
        others = [other for other in _with(below, run.scope.environment) if other != package]
        if len(others) > 1:
            others = [other for other in others if other in _words_of(run.context.file)]
        return named.sub(rf"\g<1>{others[0]}", written) if len(others) == 1 else None
    return None


def _with(below: str, environment: Mapping[str, str]) -> Iterator[str]:
    for prefix in prefixes(environment):
        for package in packages(prefix):
            if is_file(str(prefix / "share" / package / below)):
                yield package


def _words_of(file: str | None) -> set[str]:
    try:
        return set(re.findall(r"\w+", Path(file).read_text("utf-8"))) if file else set()
    except (OSError, ValueError):
        return set()

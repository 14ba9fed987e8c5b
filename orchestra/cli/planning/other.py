"""The plan that another one is compared with: what the words behind `--diff` mean."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Final

from orchestra import pipeline
from orchestra.cli.planning import revisions, sources
from orchestra.errors import UsageError
from orchestra.location import is_file

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

    from orchestra.cli.planning.sources import Made


_OF_FILES: Final = (".py", ".xml", ".yaml", ".yml", ".launch", ".json")


def other(words: Sequence[str], options: Namespace, first: Made) -> Made:
    """Make the plan that is meant: a file, a saved plan, a git revision, or other arguments of the same file.

    Arguments are taken from the first plan where there are none behind `--diff`; but the same file is then meant
    without any, since otherwise nothing could differ. Raises `UsageError` and `DescriptionError`.
    """
    names = [word for word in words if ":=" not in word]
    arguments = [word for word in words if ":=" in word]
    if len(names) == 1 and sources.is_saved(names[0]):
        sources.refuse_words(arguments, names[0])
        return sources.saved(names[0])
    if not names:
        return sources.from_file(_launch_file(first), arguments, options)
    own = arguments or [word for word in options.words if ":=" in word]
    if len(names) == 1 and not is_file(names[0]):
        found = revisions.find(names[0], first.file)
        if found is not None:
            return revisions.made(found, own, options)
    file = _found(names, first)
    if not arguments and first.file is not None and os.path.realpath(file) == os.path.realpath(first.file):
        own = []
    return sources.from_file(file, own, options)


def _found(names: Sequence[str], first: Made) -> str:
    """Return the launch file that words name. Raises `UsageError`; a word that may mean a revision is told as such."""
    try:
        return pipeline.find_launch_file(names)[0]
    except UsageError:
        if len(names) > 1 or names[0].endswith(_OF_FILES):
            raise
    reason = revisions.why_none(first.file)
    raise UsageError(f"{names[0]!r} is no launch file, no saved plan and no git revision{reason}")


def _launch_file(first: Made) -> str:
    if first.file is None:
        raise UsageError("a saved plan has no other arguments: --diff needs a file")
    return first.file

"""Where a plan comes from: a launch file with arguments, or a plan that has been saved."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra import pipeline
from orchestra.cli import inputs, launch_prefix, leaving
from orchestra.dataclass import dataclass
from orchestra.errors import DescriptionError, Problems, UsageError
from orchestra.fields import field, replace
from orchestra.location import displayed, is_file
from orchestra.patterns import pattern
from orchestra.plan.model import Plan

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Sequence

    from orchestra.resolve.packages import InstalledPackages

# A saved plan begins with its version, in JSON and in YAML.
_SAVED = pattern(r"\s*(?:\{\s*\"version\"|version)\s*:\s*\d+\s*,?\s*\"?file\"?\s*:")
_BEGINNING = 200


@dataclass(frozen=True, slots=True)
class Made:
    """A plan, what it is of, the launch file (None for a saved plan), and the files that code has written for it.

    `files` are by their path in the plan, below `${run}`. `launch` is what else there is of the plan: to take it apart
    takes time that a command which ends soon need not spend.
    """

    plan: Plan
    label: str
    file: str | None
    files: dict[str, bytes] = field(default_factory=dict)
    launch: pipeline.Launch | None = field(default=None, compare=False, repr=False)


def made(options: Namespace) -> Made:
    """Make the plan that the options ask for. Raises as `inputs.plan_from` does."""
    if options.words and is_saved(options.words[0]):
        refuse_words(options.words[1:], options.words[0])
        return saved(options.words[0])
    if not options.words:
        raise UsageError("a launch file is missing")
    launch_prefix.check(options)
    file, words = pipeline.find_launch_file(options.words)
    return from_file(file, words, options)


def from_file(
    file: str, words: Sequence[str], options: Namespace, packages: InstalledPackages | None = None
) -> Made:
    """Make the plan of a launch file with the words for it, and what else the options say.

    Raises `UsageError`, and `DescriptionError` where there are problems.
    """
    given = inputs.inputs_of(words, options)
    problems = Problems()
    with (
        leaving.contained(),
        pipeline.opened(file, replace(given, launching=False), problems, packages=packages) as launch,
    ):
        if launch is None or problems.errors:
            raise DescriptionError(problems.ordered)
        if options.strict and inputs.has_warnings(launch.plan):
            raise DescriptionError(inputs.as_errors(launch.plan.problems))
        files = written(launch.files.folder) if launch.files.used else {}
        return Made(launch.plan, " ".join([displayed(file), *words]), file, files, launch)


def written(folder: str | None) -> dict[str, bytes]:
    """Return the contents of the temporary files of launch files' code, by their path in a plan."""
    if folder is None:
        return {}
    paths = sorted(path for path in Path(folder).rglob("*") if path.is_file())
    return {f"{pipeline.FILES}/{path.relative_to(folder)}": path.read_bytes() for path in paths}


def is_saved(path: str) -> bool:
    """Return whether a file is a plan that has been saved."""
    if not is_file(path):
        return False
    with open(path, encoding="utf-8", errors="replace") as file:  # noqa: PTH123 - may be any path
        begin = file.read(_BEGINNING)
    # Seldom more than one look is needed, and an expression has to be compiled for it.
    return begin.lstrip().startswith(("{", "version")) and _SAVED.match(begin) is not None


def refuse_words(words: Sequence[str], path: str) -> None:
    """Raise `UsageError` for words behind a plan that has been saved."""
    if words:
        raise UsageError(f"{path} is a saved plan, which takes no {words[0]}")


def saved(path: str) -> Made:
    """Read a plan that `--format json` or `--format yaml` has written. Raises `UsageError` where it is none."""
    # Few plans come from one.
    from orchestra.plan import codec  # noqa: PLC0415
    from orchestra.plan.render import yaml_text  # noqa: PLC0415

    text = Path(path).read_bytes()
    try:
        plan = codec.loads(text) if text.lstrip().startswith(b"{") else yaml_text.loads(text)
    except ValueError as error:
        first = str(error).partition("\n")[0]
        raise UsageError(f"{path} cannot be read as a plan: {first}") from error
    return Made(plan, os.fspath(path), None)

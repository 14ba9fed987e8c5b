"""Whole command lines that are one text where each word stands for itself: no program has such a name."""

from __future__ import annotations

import os
import re
import shlex
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.resolve.paths import beside
from orchestra.resolve.runnable import program_on_path

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution

_NAME: Final = re.compile(r"[A-Za-z][\w.+-]*")
_BUILT_IN: Final = frozenset({"cd", "exec", "export", "source", "unset"})
# Programs that a robot has and the machine of a check may lack.
_ELSEWHERE: Final = frozenset({"gazebo", "gz", "gzclient", "gzserver", "ign", "ros2", "rviz2", "xacro"})
_OF_A_SHELL: Final = re.compile(r"[$&*;<>`|~]|\$\(")
_LONGEST: Final = 100  # characters: what is longer is read better without a suggestion


def is_one_text(words: Sequence[Value], run: Resolution) -> bool:
    """Report a program whose name is a whole command line."""
    name = words[0].text
    first, blank, rest = name.strip().partition(" ")
    if not blank or not _is_program(first, rest, run) or _is_there(name, run):
        return False
    python = is_python(words[0].location)
    shell = "shell=True" if python else "'shell: true'"
    is_shells = first in _BUILT_IN or _OF_A_SHELL.search(rest) is not None
    apart = "" if is_shells else "its words are to stand apart, or "
    message = f"there is no program '{name.strip()}': {apart}{shell} hands it to a shell"
    meant = None if is_shells or not python else _apart(words[0])
    run.problems.error(Code.MISSING_EXECUTABLE, message, words[0].location, suggestion=meant)
    return True


def _is_program(first: str, rest: str, run: Resolution) -> bool:
    """Return whether the first word is the name of a program, or looks like one before its options."""
    if os.path.isabs(first):  # noqa: PTH117 - pathlib is slow
        return os.access(first, os.X_OK) and os.path.isfile(first)  # noqa: PTH113 - as above
    if _NAME.fullmatch(first) is None:
        return False
    known = first in _ELSEWHERE or first in _BUILT_IN or rest.lstrip().startswith("-")
    return known or program_on_path(first, run.scope.environment) is not None


def _is_there(name: str, run: Resolution) -> bool:
    """Return whether there is a program of the whole name, blanks and all."""
    if os.sep not in name:
        return program_on_path(name, run.scope.environment) is not None
    return os.path.exists(name) or bool(beside(run.context.file, name))  # noqa: PTH110 - as above


def _apart(word: Value) -> str | None:
    """Return the words of a text, each in quotes."""
    from orchestra.compat.rewritten import Rewritten  # noqa: PLC0415 - only mistakes need it

    try:
        words = shlex.split(word.text)
    except ValueError:
        return None
    made = ", ".join(map(repr, words))
    return Rewritten(made) if word.verbatim and len(made) <= _LONGEST else None

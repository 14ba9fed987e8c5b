"""`executable`."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.description.text import raw_of, span_of
from orchestra.errors import Code
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.programs import program_words
from orchestra.resolve.running import Program, add_process
from orchestra.resolve.worded import look_at_paths
from orchestra.resolve.words import split

if TYPE_CHECKING:
    from orchestra.description.actions.executable import Executable
    from orchestra.resolve.resolution import Resolution


def visit(action: Executable, run: Resolution) -> None:
    """Start a program."""
    with run.scope.tracing() as reads:
        words = _words(action, run)
    label = run.text(action.name)
    namespace = run.scope.namespace(run.place(action))
    found: tuple[str, ...] = () if isinstance(words, Poison) else words
    program = Program(
        kind="process",
        executable=_called(found[0]) if found else raw_of(action.cmd),
        words=found,
        namespace=namespace if isinstance(namespace, Value) else None,
        label=label if isinstance(label, str) else None,
        faulty=any(isinstance(value, Poison) for value in (words, label, namespace)),
        through=tuple(reads),
    )
    add_process(action, program, run)


def _called(program: str) -> str:
    name = os.path.basename(program)  # noqa: PTH119 - pathlib is slow
    return name if name not in ("", ".") else Path(program).name


def _words(action: Executable, run: Resolution) -> tuple[str, ...] | Poison:
    """Return the words of the command, its program found where it is a path."""
    words = split(action.cmd, run.context)
    if isinstance(words, Poison):
        return POISON
    rest = tuple(word.text for word in words[1:])
    if not words or not words[0].text:
        run.problems.error(Code.BAD_VALUE, "the command is empty", run.at(span_of(action.cmd) or action.span))
        return POISON
    if run.flag(action.shell, default=False) is True:
        return (words[0].text, *rest)
    first = words[0]
    look_at_paths(words[1:], run)
    program = program_words(first.text, first.location, run, elsewhere=action.cwd is not None)
    return POISON if isinstance(program, Poison) else (*program, *rest)

"""`executable`."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.text import span_of
from orchestra.errors import Code
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.model import ResolvedProcess
from orchestra.resolve.programs import is_missing, program_words
from orchestra.resolve.running import add_process
from orchestra.resolve.worded import look_at_paths
from orchestra.resolve.words import split

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.actions.executable import Executable
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution

_INTERPRETERS: Final = frozenset({"bash", "python", "python3", "sh"})
_OF_A_SHELL: Final = frozenset({"|", "||", "&&", ">", ">>", "2>", "2>&1", "&>"})


def visit(action: Executable, run: Resolution) -> None:
    """Start a program."""
    with run.scope.tracing() as reads:
        words = _words(action, run)
    label = run.text(action.name)
    at = run.place(action)
    namespace = run.scope.namespace(at)
    process: Any = _new(ResolvedProcess)  # what is not said of it is as the class has it
    process.kind = "process"
    process.location = at
    process.origin = action.origin
    process.program = () if isinstance(words, Poison) else words
    process.executable = _called(process.program[0]) if process.program else _raw_of(action.cmd)
    process.namespace = namespace if isinstance(namespace, Value) else None
    process.label = label if isinstance(label, str) else None
    process.faulty = any(isinstance(value, Poison) for value in (words, label, namespace))
    process.through = tuple(reads)
    add_process(action, process, run)


_new: Final = object.__new__


def _raw_of(value: Template | tuple[Template, ...]) -> str:
    """Return a value as written, the items of a list with blanks between them."""
    return " ".join(item.raw for item in value) if isinstance(value, tuple) else value.raw


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
    _check_words(words[1:], run)
    first = words[0]
    if " " in first.text and _is_one_text(words, run):
        return POISON
    if action.cwd is None and _file_is_missing(words, run):
        return POISON
    look_at_paths(words[1:], run)
    program = program_words(first.text, first.location, run, elsewhere=action.cwd is not None)
    return POISON if isinstance(program, Poison) else (*program, *rest)


def _is_one_text(words: Sequence[Value], run: Resolution) -> bool:
    from orchestra.resolve.one_text import is_one_text  # noqa: PLC0415 - few programs have blanks in their names

    return is_one_text(words, run)


def _file_is_missing(words: Sequence[Value], run: Resolution) -> bool:
    """Report a program, or the script that an interpreter is to run, that is named by a path and is not there."""
    script = os.path.basename(words[0].text) in _INTERPRETERS and len(words) > 1  # noqa: PTH119 - as above
    named = words[1] if script else words[0]
    return os.path.isabs(named.text) and is_missing(named, run)  # noqa: PTH117 - as above


def _check_words(words: Sequence[Value], run: Resolution) -> None:
    """Tell of the first word that means something to a shell alone, where none is asked for."""
    for word in words:
        if word.text in _OF_A_SHELL:
            message = (
                f"'{word.text}' is handed to the program as it is: only with shell=true it is the shell's"
            )
            run.problems.warning(Code.BAD_VALUE, message, word.location)
            return

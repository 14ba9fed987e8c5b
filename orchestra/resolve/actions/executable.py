"""`executable`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.resolve.context import Poison
from orchestra.resolve.programs import program_words
from orchestra.resolve.running import Program, add_process, texts

if TYPE_CHECKING:
    from orchestra.description.actions.executable import Executable
    from orchestra.resolve.resolution import Resolution


def visit(action: Executable, run: Resolution) -> None:
    """Start a program."""
    words = texts(action.cmd, run)
    label = run.text(action.name)
    shell = run.flag(action.shell, default=False)
    if not isinstance(words, Poison) and words and shell is not True:
        first = program_words(words[0], run.at(action.cmd.span), run)
        words = first if isinstance(first, Poison) else (*first, *words[1:])
    found: tuple[str, ...] = () if isinstance(words, Poison) else words
    program = Program(
        kind="process",
        executable=Path(found[0]).name if found else action.cmd.raw,
        words=found,
        namespace=run.scope.namespace,
        label=label if isinstance(label, str) else None,
        faulty=isinstance(words, Poison) or isinstance(label, Poison),
    )
    add_process(action, program, run)

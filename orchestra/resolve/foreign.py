"""Variables as other languages write them: `$world`, `${world}`, `{{ world }}`. They stay the texts that they are.

Told is only of names that the file declares or that are set where it is read: `${HOME}` may be for a shell; of
substitutions as they are made in Python whatever they name.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.description.actions.arg import Arg
from orchestra.description.actions.executable import Executable
from orchestra.description.actions.let import Let
from orchestra.description.text import Call, Words
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import is_within
from orchestra.patterns import pattern
from orchestra.resolve.mentions import entities_in, templates_of
from orchestra.resolve.python_forms import MADE, meant

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.launch import Description
    from orchestra.description.text import Template
    from orchestra.location import Span
    from orchestra.resolve.resolution import Resolution

_FOREIGN: Final = pattern(
    r"(?<![\\$])\$(?:\{\s*([A-Za-z_]\w*)\s*\}|([A-Za-z_]\w*))|\{\{\s*([A-Za-z_]\w*)\s*\}\}"
)


_SHELL: Final = pattern(r"(?:^|[\s/'\"])(?:ba|da|z|k)?sh(?:$|\s)")


def warn_of_foreign(description: Description, run: Resolution) -> None:
    """Tell of variables in a file, which has been visited, that are none for the way in which they are written."""
    entities = [item for item in entities_in(description.actions) if not _is_for_shell(item)]
    declared = {item.name.constant for item in entities if isinstance(item, Arg | Let)}
    known = declared | set(run.scope.variables)
    told: dict[int, list[Span]] = {}
    for problem in run.problems:
        if problem.span is not None:
            told.setdefault(problem.span.line, []).append(problem.span)
    for entity in entities:
        for template in templates_of(entity):
            for name, span, written in _found(template):
                beside = told.get(span.line, ())
                made = name.startswith("$(")
                if (made or name in known) and not any(
                    is_within(span, at) or is_within(at, span) for at in beside
                ):
                    instead = name if made else f"$(var {name})"
                    what = "substitution" if made else "variable"
                    message = f"{written} stays a text: a {what} is written {instead}"
                    run.problems.warning(Code.SUBSTITUTION_SYNTAX, message, run.at(span), suggestion=instead)


def _is_for_shell(entity: object) -> bool:
    """Return whether a program is run by a shell, which has variables of its own."""
    if not isinstance(entity, Executable):
        return False
    words = entity.cmd if isinstance(entity.cmd, tuple) else (entity.cmd,)
    return entity.shell is not None or any(_SHELL.search(word.raw) for word in words)


def _found(template: Template) -> Iterator[tuple[str, Span, str]]:
    """Yield the names of such variables, or the substitutions meant, with their places and how they are written."""
    for part in template.parts:
        if isinstance(part, Call):
            for argument in part.arguments:
                yield from _found(argument)
        elif isinstance(part, Words):
            for found in _FOREIGN.finditer(part.text):
                if f"\\{found[0]}" not in template.raw:  # else it is meant as it stands
                    yield found[1] or found[2] or found[3], _place(part, *found.span()), found[0]
            for found in MADE.finditer(part.text):
                yield meant(found), _place(part, *found.span()), found[0]


def _place(words: Words, begin: int, end: int) -> Span:
    """Return the place of characters: exact where the text is written as it reads, else that of the whole piece."""
    span = words.span
    if span.line != span.end_line or span.end_column - span.column != len(words.text):
        return span
    return replace(span, column=span.column + begin, end_column=span.column + end)

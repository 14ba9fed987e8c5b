"""What the substitutions share that look a name up and may have a default."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.patterns import pattern
from orchestra.resolve.context import POISON, Poison
from orchestra.resolve.refusals import refuse
from orchestra.resolve.substitutions.arguments import made

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.text import Call, Template
    from orchestra.resolve.context import Context, Evaluated, ReadKind
    from orchestra.resolve.substitutions.arguments import Evaluate

_SEPARATORS: Final = (",", ":", "=")
_OF_A_SHELL: Final = pattern(r"\$(?:(\w+)|\{(\w+)\})")


def looked_up(
    call: Call,
    context: Context,
    evaluate: Evaluate,
    *,
    find: Callable[[str], Evaluated | str | None],
    report: Callable[[str, Template, Context], Poison],
    kind: ReadKind | None = None,
) -> Evaluated:
    """Return what `find` has for the first argument, else the second one, which is evaluated only then.

    Where there is neither, `report` tells so of the name, which is written as a text. What is found is noted as
    something of a `kind` that was read, unless `find` does so.
    """
    written = call.arguments[0]
    name = evaluate(written, context)
    if isinstance(name, Poison):
        return POISON
    value = find(name.text)
    if kind is not None and isinstance(value, str):
        context.variables.note(kind, name.text, value)
    if value is None and written.constant is not None and (shell := _OF_A_SHELL.fullmatch(name.text)):
        told = "a name alone stands here, without '$'"
        return refuse(written, context, Code.SUBSTITUTION_SYNTAX, told, meant=shell[1] or shell[2])
    if value is None and len(call.arguments) > 1:
        if name.text[-1:] in _SEPARATORS and written.constant is not None:
            told = f"blanks alone separate arguments: the name is '{name.text}' here"
            return refuse(written, context, Code.SUBSTITUTION_SYNTAX, told, meant=name.text[:-1])
        value = evaluate(call.arguments[1], context)
    if value is None:
        return report(name.text, written, context)
    if isinstance(value, Poison):
        return POISON
    return made(call, context, value if isinstance(value, str) else value.text)

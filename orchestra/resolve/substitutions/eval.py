"""`$(eval expression [modules])`: the result of a Python expression.

As upstream, the expression is unrestricted Python and sees the members of `math`, unless other modules are named.
It may run as long as it likes. Only what it raises is kept from ending the process.
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

from orchestra.compat.expressions import visible
from orchestra.compat.seam import connection, is_connected
from orchestra.errors import Code
from orchestra.location import is_python
from orchestra.resolve.context import POISON
from orchestra.resolve.python.environ import put_environment
from orchestra.resolve.substitutions.arguments import made, texts

if TYPE_CHECKING:
    from orchestra.description.text import Call
    from orchestra.resolve.context import Context, Evaluated
    from orchestra.resolve.substitutions.arguments import Evaluate


def perform(call: Call, context: Context, evaluate: Evaluate) -> Evaluated:
    """Return the `str` of what the expression gives."""
    words = texts(call, context, evaluate)
    if words is None:
        return POISON
    expression, modules = words[0].strip(), words[1] if len(words) > 1 else "math"
    # Here, because few launch files have expressions.
    from orchestra.resolve.substitutions.constant_expressions import of_constants  # noqa: PLC0415

    known = of_constants(expression) if len(words) == 1 else None
    if known is not None:
        return made(call, context, known)
    names: dict[str, object] = {}
    if is_connected() and is_python(call.span):
        connection().prepare()  # the code that it stands in may be known to change nothing
    try:
        with warnings.catch_warnings(record=True) as doubts:
            warnings.simplefilter("always")
            put_environment(context.environment)  # an expression may read os.environ
            names.update(visible(modules))
            text = str(eval(expression, names))  # noqa: S307 - unrestricted Python is what $(eval) is
    except (Exception, GeneratorExit, SystemExit) as error:  # noqa: BLE001 - it may raise whatever it likes
        return _failed(call, context, words[0], error, names)
    for doubt in doubts:
        context.problems.warning(Code.BAD_EXPRESSION, str(doubt.message), context.at(call.span))
    return made(call, context, text)


def _failed(
    call: Call, context: Context, text: str, error: BaseException, names: dict[str, object]
) -> Evaluated:
    # Here, because only mistakes need it.
    from orchestra.resolve.substitutions.blamed import blamed, in_quotes, meant_by, of_booleans, of_ros1  # noqa: PLC0415

    notes, written = [], call.arguments[0]
    if written.constant is None:
        notes.append(f"the expression is {text.strip()!r} here")
    span, is_written = blamed(written, text, error)
    meant = meant_by(text, error, names)
    if meant is not None and not is_written:
        notes.append(f"did you mean {meant!r}?")
    told = f"this expression fails: {type(error).__name__}: {_message(error)}"
    suggestion = meant if is_written else None
    if isinstance(error, NameError) and error.name and suggestion is None:
        if span is not None and (of_old := of_ros1(written, text, span)) is not None:
            span, suggestion = of_old
        elif span is not None and not is_python(span):
            suggestion = in_quotes(written, span, error.name, context.variables.names(), context.file)
        if suggestion is None and (whole := of_booleans(written, error.name)) is not None:
            span, suggestion = call.span, whole
        if suggestion is None and meant is None:
            notes.append(f"text needs quotes of its own: '{error.name}'")
    context.problems.error(
        Code.BAD_EXPRESSION, told, context.at(span or call.span), suggestion=suggestion, notes=notes
    )
    return POISON


def _message(error: BaseException) -> str:
    """Return what an exception says, even where saying it fails too."""
    if isinstance(error, SyntaxError):
        return error.msg
    try:
        return str(error)
    except Exception:  # noqa: BLE001 - the expression may have made an exception of its own
        return "it cannot even say why"

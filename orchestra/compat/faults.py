"""An exception of user code as a problem: at the user's own line, with the calls that led there."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from orchestra.compat.ament_index_python.packages import PackageNotFoundError
from orchestra.compat.explanation import Explanation, in_their_words
from orchestra.compat.place import Argument, Place, is_own
from orchestra.compat.refusing import Refusing
from orchestra.compat.seam import debugging
from orchestra.compat.syntax_errors import span_of_syntax
from orchestra.compat.wrong import WrongValue
from orchestra.errors import Code, Problem
from orchestra.witness.origins import INSTALLED, PYTHON

if TYPE_CHECKING:
    from types import TracebackType

    from orchestra.errors import Problems
    from orchestra.location import Span

_MOST_CALLS = 8


def report(error: BaseException, problems: Problems, chain: tuple[Span, ...], fallback: Span) -> None:
    """Report what user code has raised; `fallback` is where it was called, `chain` the includes on the way."""
    known = getattr(error, "problems", None)
    if isinstance(known, tuple):
        for problem in known:
            problems.report(problem)
        return
    calls = _calls(error.__traceback__)
    spans = [Place(call.tb_frame.f_code, call.tb_lasti).span for call in calls]
    instead: str | None = None
    missing: tuple[str, ...] = ()
    if isinstance(error, SyntaxError) and not (error.filename or "<").startswith("<"):
        span, instead, missing = span_of_syntax(error)
        spans.append(span)
    explanation = _of_what_is_not_here(error, calls) or _explained(error, calls[-1] if calls else None)
    at = explanation.span or (spans[-1] if spans else fallback)
    callers = list(dict.fromkeys(f"called at {span}" for span in spans[-2::-1]))
    notes = (*explanation.notes, *missing, *callers[:_MOST_CALLS])
    if debugging():
        from traceback import format_exception  # noqa: PLC0415 - slow, and few ask for it

        notes = (*explanation.notes, "".join(format_exception(error)).rstrip())
    problems.report(
        Problem(
            explanation.code,
            explanation.severity,
            explanation.message,
            at,
            chain,
            suggestion=explanation.suggestion or instead,
            notes=notes,
        )
    )


def _calls(traceback: TracebackType | None) -> list[TracebackType]:
    """Return the user's lines on the way to where it happened, outermost first.

    Lines of installed packages stand for the user's only where there is no line of the user's own.
    """
    own: list[TracebackType] = []
    installed: list[TracebackType] = []
    while traceback is not None:
        file = traceback.tb_frame.f_code.co_filename
        if file.startswith(INSTALLED):
            installed.append(traceback)
        elif not is_own(file) and not file.startswith(("<", *PYTHON)):
            own.append(traceback)
        traceback = traceback.tb_next
    return own or installed[-1:]


def _explained(error: BaseException, call: TracebackType | None) -> Explanation:
    """Return what the exception means; what Python says of it where nothing better is known."""
    found = (
        None
        if call is None
        else _of_unset(error, call)
        or _of_tuple(error, call)
        or _of_machine(error, call)
        or _better(error, call)
    )
    if found is not None:
        return found
    if isinstance(error, WrongValue):
        # Here, because only mistakes need it, and what it imports.
        from orchestra.compat.rewritten import rewritten  # noqa: PLC0415
        from orchestra.compat.suggestions import whole  # noqa: PLC0415

        message = in_their_words(" ".join(str(error).split()))
        span, meant = None if error.at is None else whole(error.at), error.suggestion
        if meant is None and error.at is not None and span is not None:
            at = error.at
            file = at.place.file if isinstance(at, Argument) else str(Path(span.file).absolute())
            meant = rewritten(file, span, error.value, message)
        return Explanation(message, error.code, span, meant)
    code = Code.SYNTAX if isinstance(error, SyntaxError) else Code.USER_CODE
    return Explanation(_message(error), code)


def _of_what_is_not_here(error: BaseException, calls: list[TracebackType]) -> Explanation | None:
    # Here, because only mistakes need it, and what it imports.
    from orchestra.compat import done_without  # noqa: PLC0415

    return done_without.explained(error, calls, _message(error)) if calls else None


def _of_unset(error: BaseException, call: TracebackType) -> Explanation | None:
    # Here, because only mistakes need it, and what it imports.
    from orchestra.compat import unset_variables  # noqa: PLC0415

    return unset_variables.explained(error, call)


def _of_machine(error: BaseException, call: TracebackType) -> Explanation | None:
    # Here, because only mistakes need it, and what it imports.
    from orchestra.compat import of_the_machine  # noqa: PLC0415

    return of_the_machine.explained(error, Place(call.tb_frame.f_code, call.tb_lasti))


def _of_tuple(error: BaseException, call: TracebackType) -> Explanation | None:
    # Here, because only mistakes need it, and what it imports.
    from orchestra.compat import trailing_commas  # noqa: PLC0415

    return trailing_commas.explained(error, Place(call.tb_frame.f_code, call.tb_lasti))


def _better(error: BaseException, call: TracebackType) -> Explanation | None:
    # Here, because only mistakes need them, and what they import.
    from orchestra.compat import (  # noqa: PLC0415
        call_meant,
        idle_logic,
        loops_meant,
        missing_commas,
        missing_files,
        missing_keys,
        missing_packages,
        no_terminal,
        refused_calls,
        too_early,
        unknown_names,
        wrong_brackets,
    )

    frame, place = call.tb_frame, Place(call.tb_frame.f_code, call.tb_lasti)
    match error:
        case PackageNotFoundError():
            return missing_packages.explained(error, place)
        case EOFError() | OSError():
            return (
                missing_files.explained(error, place)
                if isinstance(error, FileNotFoundError)
                else no_terminal.explained(error, place)
            )
        case ImportError():
            return unknown_names.not_in_module(error, place)
        case TypeError():
            without_comma = missing_commas.before_brackets(error, place) if call.tb_next is None else None
            return (
                without_comma
                or wrong_brackets.explained(error, frame, place)
                or refused_calls.explained(error, frame, place)
                or too_early.explained(error, frame, place)
            )
        case KeyError():
            return missing_keys.explained(error, frame, place)
        case NameError() if call.tb_next is None:
            return idle_logic.unset_by_colon(error, place) or unknown_names.unbound(error, frame, place)
        case AttributeError() if call.tb_next is None or isinstance(error.obj, ModuleType | Refusing):
            return unknown_names.no_attribute(error, place)
        case _:
            is_of_set = isinstance(error, ValueError) and "dictionary update sequence" in str(error)
            return (
                call_meant.explained(error, frame, place) if is_of_set else None
            ) or loops_meant.explained(error, place)


def _message(error: BaseException) -> str:
    if isinstance(error, SyntaxError):
        return f"this is not Python: {error.msg}"
    if isinstance(error, SystemExit):
        return f"the code ends the program: SystemExit({error.code!r})"
    text = in_their_words(" ".join(str(error).split("\n")))
    return f"{type(error).__name__}: {text}" if text else type(error).__name__

"""An exception of user code as a problem: at the user's own line, with the calls that led there."""

from __future__ import annotations

import sysconfig
from traceback import format_exception
from typing import TYPE_CHECKING

from orchestra.compat.place import is_own, shown, span_of
from orchestra.compat.seam import debugging
from orchestra.errors import Code, Problem, Severity
from orchestra.location import Span
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from types import TracebackType

    from orchestra.errors import Problems

_PYTHON = tuple({sysconfig.get_path("stdlib"), sysconfig.get_path("purelib"), sysconfig.get_path("platlib")})
_MOST_CALLS = 8


class ReportedError(RuntimeError):
    """Stops user code for a fault that has been reported, or will be with `problems`."""

    def __init__(self, message: str, problems: tuple[Problem, ...] = ()) -> None:
        super().__init__(message)
        self.problems = problems


def report(error: BaseException, problems: Problems, chain: tuple[Span, ...], fallback: Span) -> None:
    """Report what user code has raised; `fallback` is where it was called, `chain` the includes on the way."""
    known = getattr(error, "problems", None)
    if isinstance(known, tuple):
        for problem in known:
            problems.report(problem)
        return
    spans = _calls(error.__traceback__)
    if isinstance(error, SyntaxError) and error.filename is not None:
        spans.append(_syntax(error))
    at = spans[-1] if spans else fallback
    notes = tuple(f"called at {span}" for span in spans[-2 : -2 - _MOST_CALLS : -1])
    if debugging():
        notes = ("".join(format_exception(error)).rstrip(),)
    code = Code.SYNTAX if isinstance(error, SyntaxError) else Code.USER_CODE
    problems.report(
        Problem(code, Severity.ERROR, _message(error), at, chain, suggestion=_suggestion(error), notes=notes)
    )


def _calls(traceback: TracebackType | None) -> list[Span]:
    """Return the user's lines on the way to where it happened, outermost first.

    Lines of libraries stand for the user's only where there is no line of the user's own.
    """
    own: list[Span] = []
    libraries: list[Span] = []
    while traceback is not None:
        code = traceback.tb_frame.f_code
        file = code.co_filename
        if not is_own(file) and not file.startswith("<"):
            found = libraries if file.startswith(_PYTHON) else own
            found.append(span_of(code, traceback.tb_lasti))
        traceback = traceback.tb_next
    return own or libraries[-1:]


def _syntax(error: SyntaxError) -> Span:
    line, column = error.lineno or 1, max(error.offset or 1, 1)
    end_line, end_column = error.end_lineno or line, error.end_offset or column
    end_line, end_column = max((end_line, end_column), (line, column))
    return Span(shown(str(error.filename)), line, column, end_line, end_column)


def _message(error: BaseException) -> str:
    if isinstance(error, SyntaxError):
        return f"this is not Python: {error.msg}"
    if isinstance(error, SystemExit):
        return f"the code ends the program: SystemExit({error.code!r})"
    text = " ".join(str(error).split("\n"))
    return f"{type(error).__name__}: {text}" if text else type(error).__name__


def _suggestion(error: BaseException) -> str | None:
    """Return the name that was meant, where Python itself would guess one."""
    name = getattr(error, "name", None)
    if isinstance(error, AttributeError) and name:
        return nearest(name, [other for other in dir(error.obj) if not other.startswith("_")])
    return None

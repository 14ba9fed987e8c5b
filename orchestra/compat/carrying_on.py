"""What user code raises does not hide what is wrong behind it: where it is known what was meant, that is run instead.

Rejected: classes and modules that give something for any name, which code that looks for a name would take for true.
So what code deals with itself never comes here.
"""

from __future__ import annotations

import ast
import re
from types import CodeType, FunctionType
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.faults import report
from orchestra.compat.mended_source import IMPORT, MendedSource
from orchestra.compat.place import is_own, shown, span_in
from orchestra.compat.reported import CARRYING, ReportedError
from orchestra.compat.source_text import text_at
from orchestra.compat.suggestions import in_place
from orchestra.compat.syntax_trees import node_span, tree_of
from orchestra.compat.too_early import IN_PATHS
from orchestra.compat.trailing_commas import NOTE
from orchestra.errors import Problems, Severity
from orchestra.location import is_within
from orchestra.witness.origins import INSTALLED, PYTHON

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType

    from orchestra.errors import Problem
    from orchestra.location import Span

# What functions do by themselves, not by what they return.
_ACTING: Final = frozenset({"emit_event", "emit_event_sync", "execute", "register_event_handler", "visit"})
_JOINING: Final = (
    "(lambda *path: __import__('launch.substitutions').substitutions.PathJoinSubstitution(path))"
)
_MOST: Final = 50  # mistakes of one file
_MISSING_NAME: Final = re.compile(r"cannot import name '(\w+)'")


class CarryingOn:
    """Goes on with one file, mistake after mistake.

    `has_guessed` tells whether more was put in place than imports of what is where it is.
    """

    def __init__(self, file: str, chain: tuple[Span, ...], fallback: Span) -> None:
        self._source = MendedSource(file)
        self._chain, self._fallback = chain, fallback
        self._told: list[Problem] = []
        self.has_guessed = False

    def problems(self, error: BaseException) -> tuple[Problem, ...]:
        """Return what an exception tells, nothing where it follows from what was put in place of mistakes."""
        found = self._found(error)
        follows = isinstance(error, OSError) or any(self._follows(problem, error) for problem in found)
        return () if self._told and follows else found

    def code(self, error: BaseException) -> CodeType | None:
        """Return the code of the file with what was meant, None where that is not known."""
        found = self._found(error)
        if len(found) != 1 or len(self._told) >= _MOST:
            return None
        self._told += found
        file = self._source.file
        meant = (
            _comma_meant(found[0]) or _meant(error, in_place(found[0]), file) or _path_meant(found[0], file)
        )
        is_import = isinstance(error, ImportError) or (meant is not None and IMPORT.fullmatch(meant[1]))
        self.has_guessed = self.has_guessed or not is_import
        return self._source.code() if meant is not None and self._source.mend(*meant) else None

    def goes_on(self, error: BaseException, function: object, known: dict[str, Any]) -> bool:
        """Let the functions of a module that has been run do what was meant; return whether that is known."""
        code = self.code(error)
        if code is None:
            return False
        codes = {(inner.co_qualname, inner.co_firstlineno): inner for inner in _inside(code)}
        if any(_ACTING.intersection(inner.co_names) for inner in codes.values()):
            return False  # what has been done would be done twice
        self._source.import_into(known)
        for item in (function, *known.values()):
            changed = getattr(item, "__func__", getattr(item, "func", item))
            if isinstance(changed, FunctionType) and changed.__code__.co_filename == self._source.file:
                old = changed.__code__
                new = codes.get((old.co_qualname, old.co_firstlineno))
                if new is not None and new.co_freevars == old.co_freevars:
                    changed.__code__ = new
        return True

    def _found(self, error: BaseException) -> tuple[Problem, ...]:
        found = Problems()
        report(error, found, self._chain, self._fallback)
        return tuple(found)

    def _follows(self, problem: Problem, error: BaseException) -> bool:
        """Return whether a problem may come from a guess: it has no suggestion, or it stands where one was told."""
        is_plain = problem.suggestion is None and not isinstance(error, ImportError)
        return problem.span in [told.span for told in self._told] or (is_plain and self.has_guessed)


def go_on(
    error: Exception, function: object, problems: Problems, chain: tuple[Span, ...], fallback: Span
) -> None:
    """Report what a function of a launch file has raised, and let it do what was meant.

    Raises `ReportedError` where that is not known.
    """
    frame = _users_frame(error)
    if frame is not None:
        known = frame.f_globals
        carrying = known.setdefault(CARRYING, CarryingOn(frame.f_code.co_filename, chain, fallback))
        problems.extend(carrying.problems(error))
        if carrying.goes_on(error, function, known):
            return
        raise ReportedError("this is reported") from error
    raise error


def _users_frame(error: BaseException) -> FrameType | None:
    """Return the innermost frame of the user's code that an exception has come through."""
    found, traceback = None, error.__traceback__
    while traceback is not None:
        file = traceback.tb_frame.f_code.co_filename
        if not is_own(file) and not file.startswith(("<", *PYTHON, *INSTALLED)):
            found = traceback.tb_frame
        traceback = traceback.tb_next
    return found


def _inside(code: CodeType) -> Iterator[CodeType]:
    """Yield the codes of the functions in a code."""
    for item in code.co_consts:
        if isinstance(item, CodeType):
            yield item
            yield from _inside(item)


def _meant(error: BaseException, problem: Problem, file: str) -> tuple[Span, str] | None:
    """Return the range that is wrong in a file, and what should stand there; None where a problem does not tell."""
    span, meant = problem.span, problem.suggestion
    if problem.severity is not Severity.ERROR or span is None or meant is None or span.file != shown(file):
        return None
    missing = _MISSING_NAME.search(str(error)) if isinstance(error, ImportError) else None
    if missing is not None and text_at(file, span) != missing[1]:  # the module is another: only for this name
        name = _imported(file, span.line, missing[1])
        return None if name is None else (name, f"from {meant} import {missing[1]}")
    return span, meant


def _comma_meant(problem: Problem) -> tuple[Span, str] | None:
    """Return the comma that makes a tuple of something, and nothing in its place."""
    return (problem.span, "") if problem.span is not None and NOTE in problem.notes else None


def _path_meant(problem: Problem, file: str) -> tuple[Span, str] | None:
    """Return what joins something that is no text yet to a path, and what can; None for any other problem."""
    span, tree = problem.span, tree_of(file)
    if IN_PATHS not in problem.message or span is None or span.file != shown(file) or tree is None:
        return None
    around = [
        call
        for call in tree.nodes
        if isinstance(call, ast.Call) and ast.unparse(call.func).endswith("path.join") and not call.keywords
    ]
    found = [call for call in around if is_within(span, node_span(file, call))]
    if not found:
        return None
    return node_span(file, found[-1].func), _JOINING


def _imported(file: str, line: int, name: str) -> Span | None:
    """Return where a name stands in the import of a line."""
    tree = tree_of(file)
    for node in () if tree is None else tree.nodes:
        if isinstance(node, ast.ImportFrom) and node.lineno == line:
            for item in node.names:
                if item.name == name:
                    end = item.col_offset + len(name.encode())
                    return span_in(file, (item.lineno, item.lineno, item.col_offset, end))
    return None

"""Settings and comments act on what has been found: here and nowhere else, before it is decided what an error stops."""

from __future__ import annotations

import os
from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Problems, Severity
from orchestra.fields import field, replace
from orchestra.location import meet
from orchestra.settings.comments import Ignore, ignores
from orchestra.settings.find import Finder
from orchestra.settings.model import LASTING, OFF, Settings, code_meant

if TYPE_CHECKING:
    from orchestra.errors import Problem
    from orchestra.location import Span

_NONE: Final = Settings()
_KEPT: Final = (
    "an error of this kind cannot be {}: what is described here would be missing in what is started"
)


def settle(problems: Problems, path: str, severity: Mapping[str, str], *, bare: bool = False) -> None:
    """Give each problem the weight that the project has decided on, and drop those that are silenced.

    The settings nearest to the file with the problem count, where there are none those of `path`, the file that was
    asked for; `severity` wins over both, a comment over all. What is wrong with the settings becomes a problem. `bare`:
    it is known that there are none for `path`.
    """
    if problems.doubted:
        problems.amend(lambda problem: None if _is_doubted(problem, problems.doubted) else problem)
    broken = Problems()
    weighing = _Weighing(os.getcwd(), Finder(broken), severity)  # noqa: PTH109 - pathlib is slow
    weighing.asked = None if bare else weighing.finder.settings(weighing.absolute(path))
    problems.amend(weighing.weighed)
    problems.extend(broken)
    problems.silencing |= weighing.used


def _is_doubted(problem: Problem, doubted: set[Span]) -> bool:
    """Return whether what is told, unless it is why a text cannot be read, may follow from how the text was taken."""
    of_text = problem.code in (Code.SYNTAX, Code.PARAMETER_SYNTAX, Code.DUPLICATE_KEY)
    return not of_text and problem.span is not None and any(meet(problem.span, other) for other in doubted)


@dataclass(slots=True)
class _Weighing:
    folder: str
    finder: Finder
    severity: Mapping[str, str]
    asked: Settings | None = None
    used: set[tuple[str, int]] = field(default_factory=set)
    _comments: dict[str, dict[int, list[Ignore]]] = field(default_factory=dict)

    def weighed(self, problem: Problem) -> Problem | None:
        """Return the problem as it counts, None where it does not."""
        lasting = problem.severity is Severity.ERROR and problem.code in LASTING
        comment = self._silencing(problem)
        if comment is not None:
            self.used.add((comment.span.file, comment.span.line))
            return _kept(problem, "silenced") if lasting else None
        settings = self._settings(problem) or _NONE
        level = self._level(problem, settings)
        if level is not None and lasting and level != Severity.ERROR:
            return _kept(problem, "lowered")
        if level == OFF:
            return None
        if level is not None:
            return replace(problem, severity=Severity(level))
        is_error = settings.strict and problem.severity is Severity.WARNING
        return replace(problem, severity=Severity.ERROR) if is_error else problem

    def absolute(self, file: str) -> str:
        """Return the path of a file as it is displayed."""
        return os.path.normpath(os.path.join(self.folder, file))  # noqa: PTH118 - pathlib is slow

    def _settings(self, problem: Problem) -> Settings | None:
        if problem.span is None:
            return self.asked
        path = self.absolute(problem.span.file)
        there = os.path.isfile(path)  # noqa: PTH113 - pathlib is slow
        return (self.finder.settings(path) if there else None) or self.asked

    def _level(self, problem: Problem, settings: Settings) -> str | None:
        if problem.code in self.severity:
            return self.severity[problem.code]
        path = "" if problem.span is None else self.absolute(problem.span.file)
        return settings.level(problem.code, path)

    def _silencing(self, problem: Problem) -> Ignore | None:
        span = problem.span
        if span is None:
            return None
        if span.file not in self._comments:
            self._comments[span.file] = _by_line(comments_in(self.absolute(span.file), span.file))
        comments = self._comments[span.file]
        last = span.end_line - (span.end_column == 1 and span.end_line > span.line)
        meant = (
            comment
            for line in (span.line, last)
            for comment in comments.get(line, ())
            if comment.means(problem.code, line)
        )
        return min(meant, key=lambda comment: (comment.span.line, comment.span.column), default=None)


def _by_line(comments: tuple[Ignore, ...]) -> dict[int, list[Ignore]]:
    found: dict[int, list[Ignore]] = {}
    for comment in comments:
        for line in comment.lines:
            found.setdefault(line, []).append(comment)
    return found


def comments_in(path: str, file: str) -> tuple[Ignore, ...]:
    """Return the comments in a file that silence problems; `file` is how it is displayed."""
    try:
        with open(path, encoding="utf-8-sig", errors="replace", newline="") as stream:  # noqa: PTH123 - pathlib is slow
            text = stream.read()
    except (OSError, ValueError):
        return ()  # whoever wanted to read it has said so
    return ignores(text, file)


def _kept(problem: Problem, what: str) -> Problem:
    return replace(problem, notes=(*problem.notes, _KEPT.format(what)))


def unused(
    comments: tuple[Ignore, ...], used: AbstractSet[tuple[str, int]], problems: Problems, *, strict: bool
) -> None:
    """Report codes that do not exist, and with `strict` comments that silence nothing."""
    known = [code.value for code in Code]
    for comment in comments:
        strange = [(code, span) for code, span in comment.codes or () if code not in known]
        for code, span in strange:
            problems.warning(
                Code.UNUSED_IGNORE, f"there is no code '{code}'", span, suggestion=code_meant(code)
            )
        if strict and not strange and (comment.span.file, comment.span.line) not in used:
            message = "nothing is silenced by this comment"
            problems.warning(Code.UNUSED_IGNORE, message, comment.span)

"""What can be wrong, and how it is told.

A fault in what the user wrote is a `Problem`, reported to the `Problems` collector that every stage is handed.
Everything else stops by raising:

    OrchestraError
    ├── DescriptionError    the collected problems; raised once, by the pipeline   exit status 2
    ├── UsageError          the command line makes no sense                        exit status 2
    └── RunError            a run could not be carried out                         exit status 1
"""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.fields import field
from orchestra.location import Location, Span
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

HERE = "on this machine"  # ends what is told of something that another machine may have
_BREAKS = pattern(r"\s*[\n\r\x0b\x0c\x85\u2028\u2029]\s*")


class Severity(StrEnum):
    """How much a problem weighs, the gravest first.

    An error keeps everything from starting. A note is worth knowing and no fault of what is written: that this machine
    lacks what another one may have.
    """

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


class Code(StrEnum):
    """The stable code of each kind of problem."""

    UNREADABLE_FILE = "ORC001"
    SYNTAX = "ORC002"
    DUPLICATE_KEY = "ORC003"
    UNKNOWN_KEY = "ORC004"
    WRONG_TYPE = "ORC005"
    MISSING_KEY = "ORC006"
    UNKNOWN_ACTION = "ORC007"
    UNKNOWN_SUBSTITUTION = "ORC008"
    SUBSTITUTION_SYNTAX = "ORC009"
    BAD_VALUE = "ORC010"
    CONFLICTING_KEYS = "ORC011"
    UNKNOWN_FORMAT = "ORC012"
    SURPRISING_SCALAR = "ORC013"
    DEPRECATED = "ORC014"

    UNDEFINED_VARIABLE = "ORC020"
    UNSET_ENVIRONMENT = "ORC021"
    MISSING_ARGUMENT = "ORC022"
    NOT_A_CHOICE = "ORC023"
    UNKNOWN_ARGUMENT = "ORC024"
    UNREAD_ARGUMENT = "ORC025"
    LEAKED_VALUE = "ORC026"
    BAD_CONDITION = "ORC027"
    INCLUDE_CYCLE = "ORC028"
    MISSING_FILE = "ORC029"
    MISSING_PACKAGE = "ORC030"
    MISSING_EXECUTABLE = "ORC031"
    BAD_EXPRESSION = "ORC032"
    COMMAND_FAILED = "ORC033"
    BAD_NAME = "ORC034"
    NO_CURRENT_FILE = "ORC035"

    USER_CODE = "ORC036"
    NO_DESCRIPTION = "ORC037"

    PARAMETER_SYNTAX = "ORC040"
    PARAMETER_TYPE = "ORC041"
    DUPLICATE_PARAMETER = "ORC042"
    UNMATCHED_SECTION = "ORC043"
    OVERRULED_PARAMETER = "ORC044"
    DEAD_REMAP = "ORC045"

    DUPLICATE_NODE = "ORC050"
    DEPENDENCY_CYCLE = "ORC051"
    UNKNOWN_DEPENDENCY = "ORC052"
    NEVER_READY = "ORC053"
    UNFIT_MACHINE = "ORC055"

    SHADOWED_ARGUMENT = "ORC070"
    IMPOSSIBLE_CONDITION = "ORC071"
    IDLE_KEY = "ORC072"
    SPLIT_TOPIC = "ORC073"
    IDLE_REMAP = "ORC074"
    CONTESTED_CORE = "ORC075"

    BROKEN_DECLARATION = "ORC090"
    UNDECLARED_PARAMETER = "ORC091"
    DECLARED_TYPE = "ORC092"
    REFUSED_VALUE = "ORC093"
    REQUIRED_PARAMETER = "ORC094"
    TOPIC_TYPE = "ORC095"
    TOPIC_QOS = "ORC096"
    UNFED_TOPIC = "ORC097"

    UNUSED_IGNORE = "ORC100"

    BAD_DEFINITION = "ORC150"
    MIDDLEWARE_SETTING = "ORC151"
    MISSING_MIDDLEWARE = "ORC152"
    VENDOR_FILE = "ORC153"
    NO_SECURITY = "ORC154"


@dataclass(frozen=True, slots=True)
class Problem:
    """One thing that is wrong.

    `suggestion` is the text that should stand in place of the span, where one is known. `included_from` lists the
    include actions that led to the file, innermost first.
    """

    code: Code
    severity: Severity
    message: str
    span: Span | None = None
    included_from: tuple[Span, ...] = ()
    suggestion: str | None = None
    notes: tuple[str, ...] = ()


@dataclass(slots=True)
class Problems:
    """Collects the problems of one pass.

    The same problem at the same place is kept once, with the fewest includes, however often its file is included.
    `silencing` has file and line of the comments that have silenced some. `doubted` are ranges of files that have been
    read as they were probably meant: what is found there may follow from that.
    """

    _found: dict[tuple[object, ...], Problem] = field(default_factory=dict)
    silencing: set[tuple[str, int]] = field(default_factory=set)
    doubted: set[Span] = field(default_factory=set)
    _by_place: dict[tuple[object, ...], list[Problem]] = field(default_factory=dict)

    def report(self, problem: Problem) -> None:
        """Keep a problem unless the same one stands already at this place."""
        key = (problem.code, problem.span, problem.message)
        known = self._found.get(key)
        if known is None:
            self._by_place.setdefault(key[:2], []).append(problem)
        if known is None or len(problem.included_from) < len(known.included_from):
            self._found[key] = problem

    def error(
        self,
        code: Code,
        message: str,
        at: Location | Span | None = None,
        *,
        suggestion: str | None = None,
        notes: Iterable[str] = (),
    ) -> None:
        """Report an error at a place."""
        self.report(_problem(Severity.ERROR, code, message, at, suggestion, notes))

    def warning(
        self,
        code: Code,
        message: str,
        at: Location | Span | None = None,
        *,
        suggestion: str | None = None,
        notes: Iterable[str] = (),
    ) -> None:
        """Report a warning at a place."""
        self.report(_problem(Severity.WARNING, code, message, at, suggestion, notes))

    def weighed(
        self,
        severity: Severity,
        code: Code,
        message: str,
        at: Location | Span | None = None,
        *,
        notes: Iterable[str] = (),
    ) -> None:
        """Report something at a place, as grave as that is where it is found."""
        self.report(_problem(severity, code, message, at, None, notes))

    def extend(self, problems: Iterable[Problem]) -> None:
        """Take over problems that another collector found."""
        for problem in problems:
            self.report(problem)

    def amend(self, amended: Callable[[Problem], Problem | None]) -> None:
        """Put another problem in place of each, or none; those that come to be the same are one."""
        found, self._found, self._by_place = self._found, {}, {}
        for problem in map(amended, found.values()):
            if problem is not None:
                self.report(problem)

    def messages(self, code: Code, span: Span) -> list[str]:
        """Return what has been reported with a code at a place."""
        return [problem.message for problem in self._by_place.get((code, span), ())]

    def take_back(self, code: Code, span: Span | None) -> None:
        """Forget what was reported with a code at a place."""
        for problem in self._by_place.pop((code, span), ()):
            self._found.pop((code, span, problem.message), None)

    def withdraw(self, problem: Problem) -> None:
        """Forget a problem."""
        self._found.pop((problem.code, problem.span, problem.message), None)

    @property
    def last(self) -> Problem | None:
        """The problem that was reported last, None where there is none."""
        return next(reversed(self._found.values()), None)

    def forget(self, code: Code, first: int) -> None:
        """Forget the problems of a code but for those among the first so many."""
        for key in list(self._found)[first:] if len(self._found) > first else ():
            if self._found[key].code is code:
                del self._found[key]

    def __iter__(self) -> Iterator[Problem]:
        return iter(self._found.values())

    def __len__(self) -> int:
        return len(self._found)

    @property
    def errors(self) -> tuple[Problem, ...]:
        """The problems that keep everything from starting, in the order in which they were found."""
        return tuple(problem for problem in self if problem.severity is Severity.ERROR)

    @property
    def ordered(self) -> tuple[Problem, ...]:
        """All problems: by file in the order of first mention, then by place."""
        files: dict[str, int] = {}
        for problem in self:
            files.setdefault(problem.span.file if problem.span else "", len(files))

        def key(problem: Problem) -> tuple[int, int, int]:
            span = problem.span
            return (files[span.file], span.line, span.column) if span else (files[""], 0, 0)

        return tuple(sorted(self, key=key))


class OrchestraError(Exception):
    """The root of what Orchestra raises on purpose."""


class DescriptionError(OrchestraError):
    """What the user wrote cannot be run; `problems` says why."""

    def __init__(self, problems: tuple[Problem, ...]) -> None:
        super().__init__(f"{len(problems)} problem{'' if len(problems) == 1 else 's'}")
        self.problems = problems


class UsageError(OrchestraError):
    """The command line makes no sense."""


class RunError(OrchestraError):
    """A run could not be carried out."""


def _problem(
    severity: Severity,
    code: Code,
    message: str,
    at: Location | Span | None,
    suggestion: str | None,
    notes: Iterable[str],
) -> Problem:
    span = at.span if isinstance(at, Location) else at
    included_from = at.included_from if isinstance(at, Location) else ()
    one_line = _BREAKS.sub(" ", message)  # what users wrote is quoted in it
    return Problem(code, severity, one_line, span, included_from, suggestion, tuple(notes))

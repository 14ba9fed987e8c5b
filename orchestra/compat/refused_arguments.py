"""Makes an object without the arguments that are wrong, which are reported: all of them, not only the first.

A keyword that is a slip is taken for the one that was meant. An object that cannot be made without what was wrong is
lost: code that uses it stops in silence, as its fault has been told.
"""

from __future__ import annotations

import inspect
import re
import sysconfig
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import in_their_words
from orchestra.compat.given import path_of, without
from orchestra.compat.keywords import keyword_meant, parameters_of, shown
from orchestra.compat.literals import argument, keyword_span
from orchestra.compat.place import Place, here, is_own
from orchestra.compat.refusing import ReportedError
from orchestra.compat.syntax_trees import tree_of
from orchestra.compat.wrong import WrongValue
from orchestra.errors import Code, Problem, Severity

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from types import FrameType

    from orchestra.compat.place import Step
    from orchestra.errors import Problems
    from orchestra.location import Span

_PYTHON: Final = sysconfig.get_path("stdlib")
_MOST: Final = 20  # wrong values of one call that are told
_MOST_CALLS: Final = 8
_MISSING: Final = re.compile(r"missing \d+ required [\w-]+ arguments?: (.*)")
_NAME: Final = re.compile(r"'\w+'")
_Parameter = inspect.Parameter


def settled(
    made: Any,
    constructor: Callable[..., None],
    given: tuple[tuple[Any, ...], Mapping[str, Any]],
    error: Exception,
    caller: FrameType,
    problems: Problems,
    chain: tuple[Span, ...],
) -> bool:
    """Report what is wrong with a call, and make the object without it; return whether the error is dealt with so."""
    if _is_caught(caller) or _is_of_users(error):
        return False
    call = _Call(made, constructor, given, caller, here(made), problems, chain)
    for _ in range(_MOST):
        if not call.explain(error):
            if call.told:
                break
            return False
        if call.is_lost:
            break
        try:
            constructor(made, *call.words, **call.named)
        except Exception as again:  # noqa: BLE001 - the next thing that is wrong with it
            error = again
        else:
            made._refused = True
            return True
    made.__dict__["_lost"] = True
    return True


@dataclass(slots=True)
class _Call:
    """A call with the arguments that are still to be tried: by name, but those (`words`) that have none."""

    made: Any
    constructor: Callable[..., None]
    given: tuple[tuple[Any, ...], Mapping[str, Any]]
    caller: FrameType
    outer: Place
    problems: Problems
    chain: tuple[Span, ...]
    told: set[tuple[Step, ...]] = field(default_factory=set)
    is_lost: bool = False
    words: tuple[Any, ...] = ()
    surplus: int | None = None
    named: dict[str, Any] = field(default_factory=dict)
    original: dict[str, Any] = field(default_factory=dict)
    parameters: dict[str, inspect.Parameter] = field(default_factory=dict)
    places: tuple[Place, ...] = ()
    kind: type[Any] = object

    def __post_init__(self) -> None:
        """Give each argument its name."""
        words, named = self.given
        made = type(self.made)
        self.kind = next(
            kind
            for kind in made.__mro__
            if getattr(vars(kind).get("__init__"), "__wrapped__", None) is self.constructor
        )
        self.parameters = {item.name: item for item in parameters_of(self.kind)}
        own = list(inspect.signature(self.constructor).parameters.values())[1:]
        by_place = [item.name for item in own if item.kind is _Parameter.POSITIONAL_OR_KEYWORD]
        if any(item.kind is _Parameter.VAR_POSITIONAL for item in own):
            self.words, self.original = words, {f"*{index}": word for index, word in enumerate(words)}
        else:
            self.surplus = len(by_place) if len(words) > len(by_place) else None
            self.named = dict(zip(by_place, words, strict=False))
        self.named |= named
        self.original |= self.named
        inner = Place(self.caller.f_code, self.caller.f_lasti, self.kind)
        self.places = (inner,) if self.outer.span == inner.span else (inner, self.outer)

    def explain(self, error: Exception) -> bool:
        """Report what an error means and leave that out; return whether it is known."""
        if isinstance(error, ReportedError):
            for problem in error.problems:
                self.problems.report(problem)
            self.told.add(())
            self.is_lost = True
            return True
        if self.surplus is not None:
            return self._surplus(self.surplus)
        unknown = [name for name in self.named if name not in self.parameters]
        if unknown and isinstance(error, TypeError):
            return self._unknown(unknown)
        missing = _MISSING.search(str(error))
        if missing is not None and isinstance(error, TypeError):
            return self._missing(_NAME.findall(missing[1]))
        return self._wrong(error)

    def _surplus(self, index: int) -> bool:
        name = self.kind.__name__
        message = f"{name} takes {index or 'no'} argument{'s' * (index != 1)} without a name"
        note = f"it is written {name}({shown(self.parameters)})"
        self._tell(Code.WRONG_TYPE, message, self._at((f"*{index}",)), notes=(note,))
        self.is_lost = True
        return True

    def _unknown(self, names: list[str]) -> bool:
        for name in names:
            meant = keyword_meant(name, self.parameters, self.named)
            spans = (keyword_span(place, name) for place in self.places)
            span = next((span for span in spans if span is not None), None)
            message = f"{self.kind.__name__} has no argument '{name}'"
            if span is None:  # it comes out of a mapping that is made elsewhere
                notes = () if meant is None else (f"did you mean '{meant}'?",)
                self._tell(Code.UNKNOWN_KEY, message, self.places[0].span, notes=notes)
            else:
                self._tell(Code.UNKNOWN_KEY, message, span, meant)
            value = self.named.pop(name)
            if meant is not None:
                self.named.setdefault(meant, value)
        self.told.add(("",))
        return True

    def _missing(self, names: list[str]) -> bool:
        if not self.told:
            message = f"{self.kind.__name__} needs {' and '.join(names)}"
            self._tell(Code.MISSING_KEY, message, self.places[-1].span)
        self.told.add(())
        self.is_lost = True
        return True

    def _wrong(self, error: Exception) -> bool:
        path = path_of(error, self.original, self.told)
        if path is None:
            return False
        code = error.code if isinstance(error, WrongValue) else Code.WRONG_TYPE
        suggestion = error.suggestion if isinstance(error, WrongValue) else None
        at = self._at(path, whole=suggestion is None)
        self._tell(code, in_their_words(" ".join(str(error).split())), at, suggestion)
        self.told.add(path)
        name = str(path[0])
        self.named = without(self.named, path) if name in self.named else self.named
        needed = name.startswith("*") or self.parameters[name].default is _Parameter.empty
        self.is_lost = needed and name not in self.named
        return True

    def _at(self, path: tuple[Step, ...], *, whole: bool = True) -> Span:
        found = (argument(place, path) for place in self.places)
        written = next((item for item in found if item.node is not None), None)
        if written is None:
            return self.places[0].span
        return written.whole if whole else written.span

    def _tell(
        self,
        code: Code,
        message: str,
        span: Span,
        suggestion: str | None = None,
        notes: tuple[str, ...] = (),
    ) -> None:
        calls = [place.span for place in _calls(self.caller)][1:]
        way = tuple(dict.fromkeys(f"called at {call}" for call in calls))[:_MOST_CALLS]
        self.problems.report(
            Problem(code, Severity.ERROR, message, span, self.chain, suggestion, (*notes, *way))
        )


def _calls(frame: FrameType) -> Iterator[Place]:
    """Yield the user's lines on the way to a call, innermost first, as far as the code of ours that has called it."""
    around: FrameType | None = frame
    while around is not None and not is_own(around.f_code.co_filename):
        if not around.f_code.co_filename.startswith(("<", _PYTHON)):
            yield Place(around.f_code, around.f_lasti)
        around = around.f_back


def _is_caught(frame: FrameType) -> bool:
    """Return whether the user's code deals with what is raised."""
    around: FrameType | None = frame
    while around is not None and not is_own(around.f_code.co_filename):
        tree = tree_of(around.f_code.co_filename)
        if tree is not None and tree.catches(around.f_lineno):
            return True
        around = around.f_back
    return False


def _is_of_users(error: Exception) -> bool:
    """Return whether code of users has raised this, that ours has called."""
    traceback = error.__traceback__
    while traceback is not None:
        file = traceback.tb_frame.f_code.co_filename
        if not is_own(file) and not file.startswith(("<", _PYTHON)):
            return True
        traceback = traceback.tb_next
    return False

"""A call that an object could not be made by: what is wrong with it, and what is left of it."""

from __future__ import annotations

import inspect
import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import in_their_words, told
from orchestra.compat.given import path_of, value_at, without
from orchestra.compat.keywords import keyword_meant, parameters_of, shown
from orchestra.compat.literals import argument, call_at, keyword_span
from orchestra.compat.reported import ReportedError
from orchestra.compat.rewritten import Rewritten, all_listed, all_named, in_brackets, in_two, named, rewritten
from orchestra.compat.syntax_trees import called_by
from orchestra.compat.wrong import WrongValue
from orchestra.errors import Code, Problem, Severity

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from orchestra.compat.place import Place, Step
    from orchestra.location import Span

_MISSING: Final = re.compile(r"missing \d+ required [\w-]+ arguments?: (.*)")
_NAME: Final = re.compile(r"'\w+'")
_AMOUNTS: Final = (
    "period",
    "respawn_delay",
    "sigkill_timeout",
    "sigterm_timeout",
)  # numbers are right in them
_TRUTHS: Final = ("prepend", "respawn")
_WORDS: Final = ("cwd", "name", "namespace", "output")  # a truth value is none of them in another form
_NO_TEXTS: Final = ("condition", "launch_arguments")
# What takes one list and hardly anything else without its name.
_TAKE_A_LIST: Final = ("Command", "GroupAction", "LaunchDescription", "PathJoinSubstitution")
_TWO: Final = 2
# What people give first, in the order of `ros2 run`.
_USUAL: Final = {name: ["package", "executable"] for name in ("LifecycleNode", "Node")}
_Parameter = inspect.Parameter


class FaultyCall:
    """A call, with the arguments that are still to be tried: by name, but those (`words`) that have none.

    `found` is what is wrong with it, without the way to it.
    """

    def __init__(
        self,
        made: Any,
        constructor: Callable[..., None],
        given: tuple[tuple[Any, ...], Mapping[str, Any]],
        way: Sequence[Place],
        outer: Place,
    ) -> None:
        words, named = given
        self.given = (*words, *named.values())
        # Without what it only refers to: that stands elsewhere, too.
        self.content = [*words, *(item for name, item in named.items() if not name.startswith("target"))]
        self.kind = _owner(type(made), constructor)
        self.name = _public_name(type(made), way[0])
        self.parameters = {item.name: item for item in parameters_of(self.kind)}
        own = list(inspect.signature(constructor).parameters.values())[1:]
        by_place = [item.name for item in own if item.kind is _Parameter.POSITIONAL_OR_KEYWORD]
        open_ended = any(item.kind is _Parameter.VAR_POSITIONAL for item in own)
        self.words = words if open_ended else ()
        self.surplus = len(by_place) if len(words) > len(by_place) and not open_ended else None
        self.named = {**({} if open_ended else dict(zip(by_place, words, strict=False))), **named}
        self.original = {**{f"*{index}": word for index, word in enumerate(self.words)}, **self.named}
        way[0].kind = self.kind
        self.places = (way[0],) if outer.span == way[0].span else (way[0], outer)
        self.way = way
        self.told: set[tuple[Step, ...]] = set()
        self.found: list[Problem] = []
        self.is_lost = False
        self.is_shortened = False

    def explain(self, error: Exception) -> bool:
        """Find what an error means and leave that out; return whether it is known."""
        if self.is_shortened:  # what else is wrong may follow from what was left out
            self.is_lost = True
            return True
        if isinstance(error, ReportedError):
            self.found += error.problems
            self.is_lost = not self._left_out(path_of(error, self.original, self.told))
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
        name = self.name
        if name in _TAKE_A_LIST:
            return self._listed()
        message = f"{name} takes {index or 'no'} argument{'s' * (index != 1)} without a name"
        note = f"it is written {name}({shown(self.parameters)})"
        at = self._at((f"*{index}",))
        meant = self._named(index, at)
        if meant is None and len(self.given) - len(self.named) == _TWO and index == 0:
            usual = _USUAL.get(name) or [item for item in self.parameters if item not in self.named][:_TWO]
            fits = not any(_is_unfit(item, word) for item, word in zip(usual, self.given, strict=False))
            at, meant = all_named(self.places[0], index, usual) if fits else (at, None)
            if meant is not None:
                self.named |= dict(zip(usual, self.given, strict=False))
                self.original |= self.named
                self.surplus = None
                self._tell(Code.WRONG_TYPE, message, at, meant, (note,))
                return True
        self._tell(Code.WRONG_TYPE, message, at, meant, (note,))
        self.surplus, self.is_shortened = None, meant is None
        self.is_lost = meant is None and (
            not _is_entity(self.kind) or any(_is_entity(type(value)) for value in self.given)
        )
        self._take_by_order(index)
        return True

    def _listed(self) -> bool:
        """Take words without a name for the items of the list that is wanted."""
        name, words = next(iter(self.parameters)), self.given[: len(self.given) - len(self.named) + 1]
        span, meant = all_listed(self.places[0])
        message = f"{self.name} takes one list, not {len(words)} arguments"
        self._tell(Code.WRONG_TYPE, message, span, meant)
        self.surplus = None
        self.named[name] = self.original[name] = list(words)
        return True

    def _named(self, index: int, at: Span) -> str | None:
        """Return the only word that is one too many with the name that it lacks, None where it may mean another."""
        left = [name for name in self.parameters if name not in self.named]
        word = self.given[index]
        is_another = word is None or (index > 0 and _is_entity(type(word)))
        if left and _is_unfit(left[0], word):
            return None
        if len(self.given) != len(self.named) + 1 or not left or is_another or at == self.places[0].span:
            return None
        return named(self.places[0].file, at, left[0])

    def _take_by_order(self, index: int) -> None:
        """Give a word without a name that is one too many to the first argument that has to be named."""
        left = [name for name in self.parameters if name not in self.named]
        if left and not _is_unfit(left[0], self.given[index]):
            self.named[left[0]] = self.original[left[0]] = self.given[index]
            self.told.add((left[0],))  # where it stands as another one is told

    def _unknown(self, names: list[str]) -> bool:
        for name in names:
            meant = keyword_meant(name, self.parameters, self.named)
            spans = (keyword_span(place, name) for place in (*self.places, *self.way))
            span = next((span for span in spans if span is not None), None)
            message = f"{self.name} has no argument '{name}'{'' if meant else self._owner(name)}"
            if span is None:  # it comes out of a mapping that is made elsewhere
                notes = () if meant is None else (f"did you mean '{meant}'?",)
                self._tell(Code.UNKNOWN_KEY, message, self.places[0].span, notes=notes)
            else:
                self._tell(Code.UNKNOWN_KEY, message, span, meant)
            value = self.named.pop(name)
            self.original.pop(name)
            if meant is not None and meant not in self.named:
                self.named[meant] = self.original[meant] = value
        return True

    def _owner(self, name: str) -> str:
        from orchestra.compat.belongings import owner_of  # noqa: PLC0415 - only mistakes need it

        owner = owner_of(name, self.name, self.places)
        return "" if owner is None else f": {owner}"

    def _missing(self, names: list[str]) -> bool:
        if not self.found and not self._are_one():
            message = f"{self.name} needs {' and '.join(names)}"
            self._tell(Code.MISSING_KEY, message, self.places[-1].span)
        self.is_lost = True
        return True

    def _are_one(self) -> bool:
        """Tell of a name and its value that are given as one argument."""
        if len(self.given) != 1 or not self.named:
            return False
        at = self._at((next(iter(self.named)),))
        meant = in_two(self.places[0].file, at, self.given[0])
        if meant is not None:
            message = f"{self.name} takes a name and its value apart, this is {told(self.given[0])}"
            self._tell(Code.WRONG_TYPE, message, at, meant)
        return meant is not None

    def _wrong(self, error: Exception) -> bool:
        path = path_of(error, self.original, self.told)
        if path in self.told:
            self.is_lost = True
            return True
        if path is None:
            return False
        code = error.code if isinstance(error, WrongValue) else Code.WRONG_TYPE
        suggestion = error.suggestion if isinstance(error, WrongValue) else None
        at = self._at(path, whole=suggestion is None and code is not Code.NOT_A_CHOICE)
        message = in_their_words(" ".join(str(error).split()))
        if suggestion is None and path[0] not in _AMOUNTS:
            suggestion = self._rewritten(path, at, message)
        wide = in_brackets(self.places[0].file, at) if "args of an OpaqueFunction" in message else None
        if wide is not None and suggestion is not None:
            at, suggestion = wide, Rewritten(f"({suggestion[1:-1]},)")
        self._tell(code, message, at, suggestion)
        self.is_lost = not self._left_out(path)
        return True

    def _left_out(self, path: tuple[Step, ...] | None) -> bool:
        """Leave out what stands at a place, and return whether the call does without it."""
        if path is None or path in self.told:
            return False
        self.told.add(path)
        name = str(path[0])
        kept = without(self.original, self.told)
        self.named = {key: value for key, value in kept.items() if not key.startswith("*")}
        needed = name.startswith("*") or self.parameters[name].default is _Parameter.empty
        return name in self.named or not needed

    def _rewritten(self, path: tuple[Step, ...], at: Span, message: str) -> str | None:
        value = value_at(path, self.original)
        if path[0] in _TRUTHS and isinstance(value, int):
            return Rewritten(repr(bool(value)))
        if path[0] in _WORDS and isinstance(value, bool):
            return None
        return rewritten(self.places[0].file, at, value, message)

    def _at(self, path: tuple[Step, ...], *, whole: bool = True) -> Span:
        """Return where a value stands, or the smallest expression that it comes out of."""
        for place in self.places:
            written = argument(place, path)
            if written.span != place.span:
                return written.whole if whole else written.span
        return self.places[0].span

    def _tell(
        self,
        code: Code,
        message: str,
        span: Span,
        suggestion: str | None = None,
        notes: tuple[str, ...] = (),
    ) -> None:
        if (code, span) not in [(problem.code, problem.span) for problem in self.found]:
            self.found.append(Problem(code, Severity.ERROR, message, span, (), suggestion, notes))


def _is_unfit(name: str, word: Any) -> bool:
    """Return whether a word cannot be what an argument of a name is given."""
    return name in _NO_TEXTS and isinstance(word, str | int | float)


def _is_entity(kind: type[Any]) -> bool:
    return callable(getattr(kind, "visit", None))


def _public_name(made: type[Any], place: Place) -> str:
    """Return the name of a class as users know it: as they write it, or of that of ours which theirs derives from."""
    ours = next(kind for kind in made.__mro__ if kind.__module__.startswith("orchestra.compat."))
    call = call_at(place)
    written = None if call is None else called_by(call)
    return written if written is not None and written.lower() == ours.__name__.lower() else ours.__name__


def _owner(made: type[Any], constructor: Callable[..., None]) -> type[Any]:
    """Return the class of ours whose constructor was called."""
    return next(
        kind
        for kind in made.__mro__
        if getattr(vars(kind).get("__init__"), "__wrapped__", None) is constructor
    )

"""Substitutions that launch files in YAML and XML have too: they turn into the same calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.place import IN_CONSTRUCTOR, Arguments, Instructions, argument, here
from orchestra.compat.text import template
from orchestra.dataclass import maker
from orchestra.description.text import (
    Call,
    Opaque,
    Pieces,
    Template,
    Words,
    matched_template,
    matched_words,
    new_call,
    new_template,
    new_words,
)
from orchestra.description.written import called, escaped
from orchestra.location import Matched

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.place import Place, Step
    from orchestra.description.text import Part
    from orchestra.location import Span


_VALUE: Final = "var"


class CallSubstitution(Substitution):
    """A substitution with a name in the launch language, and arguments that are substitutions themselves.

    A subclass that performs itself in another way (a user's) is `Opaque`, and what it is made of is known.
    """

    _name: str
    _kept: tuple[tuple[list[Substitution], ...], Template, Place] | None = None

    def __init__(self) -> None:
        self._place = here(self, IN_CONSTRUCTOR)

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        """Return the arguments of the call."""
        return ()

    def perform(self, context: LaunchContext) -> str:
        """Return what the call comes to. Raises `SubstitutionFailure`."""
        return context._engine.evaluate(Template((self._call(),), self._raw(), self._place.span))

    def _call(self, given: Sequence[Sequence[Substitution]] | None = None) -> Call:
        place, paths = self._place, self._paths()
        count, call = len(paths), Arguments(place)
        arguments: list[Template] = []
        for index, items in enumerate(self._arguments() if given is None else given):
            text = items[0].text if len(items) == 1 and type(items[0]) is TextSubstitution else None
            if index >= count:
                arguments.append(template(items, place.span))
            elif text is None or "$" in text or "\\" in text:
                arguments.append(template(items, argument(place, paths[index])))
            else:  # the same, of which words and place are made when somebody asks
                arguments.append(matched_words(text, False, call, paths[index]))  # type: ignore[arg-type] # its groups are paths
        return new_call(self._name, tuple(arguments), place.span)

    def _whole(self) -> Template | None:
        """Return the text that the call alone is; None where only the code of launch files knows what it comes to.

        It is kept as long as the arguments are the same texts.
        """
        given = tuple(self._arguments())
        kept = self._kept
        if kept is not None and kept[0] == given and kept[2] is self._place:
            return kept[1]
        others = [item for items in given for item in items if type(item) is not TextSubstitution]
        if others and not all(map(_is_known, others)):
            return None
        call = self._known_call(given)
        if call is None:
            return None
        if type(self)._raw is CallSubstitution._raw:
            raw = called(self._name, [argument.raw for argument in call.arguments])
        else:
            raw = self._raw()
        name = _variable(call)
        if name is None:
            made = new_template((call,), raw, call.span)
        else:
            made = matched_template(raw, False, _Made(self._place), 0, new_composed((call,), (name,)))
        if given and not others:
            self._kept = tuple(map(list, given)), made, self._place
        return made

    def _known_call(self, given: Sequence[Sequence[Substitution]]) -> Call | None:
        """Return what the substitution comes to where that is a call alone; its arguments are `given`."""
        kind: Any = type(self)
        if kind._parts is CallSubstitution._parts:
            return self._call(given) if kind.perform.__module__.startswith("orchestra.compat.") else None
        parts = self._parts(self._place.span)
        call = parts[0] if len(parts) == 1 else None
        return call if type(call) is Call else None

    def _paths(self) -> Sequence[tuple[Step, ...]]:
        """Return where the arguments of the call stand among those of the constructor."""
        return [(name,) for name in getattr(self, "_parameters", ())]

    def _parts(self, span: Span) -> tuple[Part, ...]:
        call = self._call()
        perform: Any = type(self).perform
        if not perform.__module__.startswith("orchestra.compat."):
            return (Opaque(self, span, call.arguments),)
        return (call,)

    def _raw(self) -> str:
        arguments = ("".join(item._raw() for item in argument) for argument in self._arguments())
        return called(self._name, arguments)


class Composed(Pieces):
    """Texts and variables that code has put together: each variable is known where it was made."""

    __slots__ = ()

    def placed(self, whole: Span) -> tuple[Part, ...]:
        """Return them as parts of a text that stands at a place."""
        pieces: tuple[Any, ...] = self.pieces
        return tuple(
            [
                new_words(piece, whole)
                if type(piece) is str
                else piece.call
                if type(piece) is _Variable
                else piece
                for piece in pieces
            ]
        )


new_composed: Final[Callable[[tuple[Any, ...], tuple[str, ...]], Composed]] = maker(Composed)


class _Variable:
    """A variable by its name alone: few texts with it are ever asked for the call that it is."""

    __slots__ = ("_call", "_name", "_place")

    def __init__(self, name: str, place: Place) -> None:
        self._name = name
        self._place = place
        self._call: Call | None = None

    @property
    def call(self) -> Call:
        """The call."""
        if self._call is None:
            name = template(self._name, argument(self._place, ("variable_name",)))
            self._call = new_call(_VALUE, (name,), self._place.span)
        return self._call


def variable(name: str, place: Place) -> Template:
    """Return the text that a variable alone is, by its name, which stands at a place."""
    pieces = new_composed((_Variable(name, place),), (name,))
    return matched_template(called(_VALUE, (escaped(name),)), False, _Made(place), 0, pieces)


class _Made(Matched):
    """What a substitution alone comes to stands where that was made."""

    __slots__ = ("_place",)

    def __init__(self, place: Place) -> None:
        self._place = place

    @property
    def whole(self) -> Instructions:  # type: ignore[override] # nobody sets it
        """The text."""
        return Instructions(self._place._code)

    def span(self, group: int) -> Span:
        """Return the place."""
        del group
        return self._place.span


def _is_known(item: Substitution) -> bool:
    """Return whether no code of launch files says what a substitution comes to, nor how it is described."""
    return isinstance(item, CallSubstitution) and item._whole() is not None


def _variable(call: Call) -> str | None:
    """Return the variable whose value a call is, None for any other one."""
    if call.name != _VALUE or len(call.arguments[0].parts) != 1:
        return None
    name = call.arguments[0].parts[0]
    return name.text if type(name) is Words else None

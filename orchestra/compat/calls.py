"""Substitutions that launch files in YAML and XML have too: they turn into the same calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.place import IN_CONSTRUCTOR, Arguments, Instructions, argument, here
from orchestra.compat.text import Composed, alone, is_changed, performing, shown, template
from orchestra.description.text import (
    Call,
    Opaque,
    PlainCall,
    Template,
    Words,
    matched_template,
    matched_words,
    new_call,
    new_template,
)
from orchestra.description.written import called, escaped
from orchestra.location import Matched

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.place import Place, Step
    from orchestra.description.text import Part
    from orchestra.location import Span


_VALUE, _PATH = "var", "path-join"
_new = object.__new__


class CallSubstitution(Substitution):
    """A substitution with a name in the launch language, and arguments that are substitutions themselves.

    A subclass that performs itself in another way (a user's) is `Opaque`, and what it is made of is known.
    """

    _name: str
    _kept: tuple[tuple[list[Substitution], ...], Template, Place] | None = None
    # What it alone is as a text, as long as it has its arguments as they were given.
    _sure: Template | None = None
    # The paths that are known by what this one is known as.
    _paths_of: list[CallSubstitution] | None = None

    def __init__(self) -> None:
        self._place = here(self, IN_CONSTRUCTOR)

    def _make(self, given: tuple[tuple[Any, ...], dict[str, Any]]) -> None:
        self._forget()
        super()._make(given)

    def _hold(self, path: CallSubstitution) -> None:
        """Let a path be known by what this one is known as."""
        if self._paths_of is None:
            self._paths_of = [path]
        else:
            self._paths_of.append(path)

    def _forget(self) -> None:
        """Be known by nothing that was given, which code may change from now on; nor are the paths with this one."""
        if self._known_as is not None:
            shown[0] += 1
        self._known_as = self._sure = None
        paths, self._paths_of = self._paths_of, None
        for path in paths or ():
            path._forget()

    def _is_noted(self) -> bool:
        """Return whether it is noted when code is shown what this one was given."""
        return self._known_as is not None

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
        known, kind = self._known_as, type(self)
        if known is None or kind.perform is not performing.get(kind) or (known[0] == _PATH and is_changed()):
            return self._looked_at()
        return self._sure or self._surely(known)

    def _surely(self, known: Any) -> Template:
        """Return the text that the call alone is, and keep it; the call is known as this."""
        matched = _new(_Kept)
        matched._made = self
        matched._given = self._as_given or self._given_again()
        composed = alone(known, self._written)
        self._sure = made = matched_template(composed.raw, False, matched, 0, composed)
        return made

    def _written(self) -> str:
        """Return how one is written that has its arguments as they were given."""
        known: Any = self._known_as
        if type(self)._raw is CallSubstitution._raw and {*map(type, known)} == {str}:
            return called(known[0], map(escaped, known[1:]))
        raw: str = self._twin(self._as_given or self._given_again())._raw()
        return raw

    def _given_again(self) -> tuple[tuple[Any, ...], dict[str, Any]]:
        """Return what may be given to make another one that is known as the same."""
        return (), {}

    def _looked_at(self) -> Template | None:
        """Return the same of what the constructor makes."""
        given = tuple(self._arguments())
        kept = self._kept
        if kept is not None and kept[0] == given and kept[2] is self._place and not is_changed():
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
            composed = Composed((PlainCall(_VALUE, (), 0, name),), (name,), None, raw)
            made = matched_template(raw, False, _Called(self._place, call), 0, composed)
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


class _Called(Matched):
    """What a substitution comes to that is a call alone, which stands where it was made."""

    __slots__ = ("_call", "_place")

    def __init__(self, place: Place, call: Call) -> None:
        self._place = place
        self._call = call

    @property
    def whole(self) -> Instructions:  # type: ignore[override] # nobody sets it
        """The text."""
        return self._place.whole

    def span(self, group: int) -> Span:
        """Return the place."""
        del group
        return self._place.span

    def parts(self, span: Span) -> tuple[Part, ...]:
        """Return the call."""
        del span
        return (self._call,)


class Made(Matched):
    """What a substitution alone comes to stands where that was made."""

    __slots__ = ("_made",)

    def __init__(self, made: CallSubstitution) -> None:
        self._made = made

    @property
    def whole(self) -> Instructions:  # type: ignore[override] # nobody sets it
        """The text."""
        return self._made._place.whole

    def span(self, group: int) -> Span:
        """Return the place."""
        del group
        return self._made._place.span


class _Kept(Made):
    """The same of one that has its arguments as they are `given`: the call is made of these when somebody asks."""

    __slots__ = ("_given",)

    _given: Any

    def parts(self, span: Span) -> tuple[Part, ...]:
        """Return the call."""
        parts: tuple[Part, ...] = self._made._twin(self._given)._parts(span)
        return parts


def own() -> Any:
    """Return a private attribute of what may have its arguments as they were given.

    What code puts there counts, also before the constructor has been asked for what it makes.
    """
    return _Own()


class _Own:
    def __set_name__(self, owner: type[Any], name: str) -> None:
        self._name = name

    def __get__(self, made: Any, kind: type[Any]) -> Any:
        try:
            return made.__dict__[self._name]
        except KeyError:
            raise AttributeError(self._name) from None

    def __set__(self, made: Any, value: Any) -> None:
        if made._as_given is not None:
            getattr(made, self._name)  # what the constructor makes
        if self._name in made.__dict__:  # else the constructor sets it
            shown[0] += 1
            if isinstance(made, CallSubstitution):
                made._forget()
        made.__dict__[self._name] = value


def _is_known(item: Substitution) -> bool:
    """Return whether no code of launch files says what a substitution comes to, nor how it is described."""
    return isinstance(item, CallSubstitution) and item._whole() is not None


def _variable(call: Call) -> str | None:
    """Return the variable whose value a call is, None for any other one."""
    if call.name != _VALUE or len(call.arguments[0].parts) != 1:
        return None
    name = call.arguments[0].parts[0]
    return name.text if type(name) is Words else None

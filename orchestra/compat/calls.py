"""Substitutions that launch files in YAML and XML have too: they turn into the same calls."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.place import argument, here
from orchestra.compat.text import template
from orchestra.description.text import Call, Opaque, Template, new_call, new_template
from orchestra.description.written import called

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.place import Step
    from orchestra.description.text import Part
    from orchestra.location import Span


class CallSubstitution(Substitution):
    """A substitution with a name in the launch language, and arguments that are substitutions themselves.

    A subclass that performs itself in another way (a user's) is `Opaque`, and what it is made of is known.
    """

    _name: str
    _kept: tuple[tuple[list[Substitution], ...], Template] | None = None

    def __init__(self) -> None:
        self._place = here(self)

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        """Return the arguments of the call."""
        return ()

    def perform(self, context: LaunchContext) -> str:
        """Return what the call comes to. Raises `SubstitutionFailure`."""
        return context._engine.evaluate(Template((self._call(),), self._raw(), self._place.span))

    def _call(self) -> Call:
        place, paths = self._place, self._paths()
        arguments = [
            template(item, argument(place, paths[index]) if index < len(paths) else place.span)
            for index, item in enumerate(self._arguments())
        ]
        return new_call(self._name, tuple(arguments), place.span)

    def _whole(self) -> Template | None:
        """Return the text that the call alone is; None where only the code of launch files knows what it comes to.

        It is kept as long as the arguments are the same texts.
        """
        given = tuple(self._arguments())
        kept = self._kept
        if kept is not None and kept[0] == given and kept[1].span is self._place.span:
            return kept[1]
        kinds = {type(item) for argument in given for item in argument}
        are_texts = kinds <= _TEXT
        if not are_texts and not all(_is_known(item) for argument in given for item in argument):
            return None
        parts = self._parts(self._place.span)
        if len(parts) != 1:
            return None
        call = parts[0]
        if type(call) is not Call:
            return None
        if type(self)._raw is CallSubstitution._raw:
            raw = called(self._name, [argument.raw for argument in call.arguments])
        else:
            raw = self._raw()
        made = new_template(parts, raw, call.span)
        if given and are_texts:
            self._kept = tuple(map(list, given)), made
        return made

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


_TEXT: Final = frozenset({TextSubstitution})


def _is_known(item: Substitution) -> bool:
    """Return whether no code of launch files says what a substitution comes to, nor how it is described."""
    return type(item) is TextSubstitution or (
        isinstance(item, CallSubstitution) and item._whole() is not None
    )

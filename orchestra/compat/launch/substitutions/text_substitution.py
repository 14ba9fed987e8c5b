"""`TextSubstitution`: plain text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.wrong import WrongType
from orchestra.description.text import new_words
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.description.text import Part
    from orchestra.location import Span


class TextSubstitution(Substitution):
    """A text. Raises `TypeError` for anything else."""

    _known_as: str | None

    def __init__(self, *, text: str) -> None:
        if not isinstance(text, str):
            told = f"the text of a TextSubstitution is a str, not {type(text).__name__}: {text!r}"
            raise WrongType(told, path=("text",))
        self.__text = text
        self._known_as = text if type(text) is str else None

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        text = keywords.get("text")
        if arguments or len(keywords) != 1 or type(text) is not str:
            return False
        self.__text = self._known_as = text
        return True

    @property
    def text(self) -> str:
        """The text."""
        return self.__text

    def describe(self) -> str:
        """Return the text in quotes."""
        return f"'{self.text}'"

    def perform(self, context: LaunchContext) -> str:  # noqa: ARG002 - there is nothing to look up
        """Return the text."""
        return self.text

    def _parts(self, span: Span) -> tuple[Part, ...]:
        if type(self).perform is not TextSubstitution.perform:
            return super()._parts(span)
        return (new_words(self.__text, span),) if self.__text else ()

    def _raw(self) -> str:
        return escaped(self.__text)


_new = object.__new__


def text_of(text: str) -> TextSubstitution:
    """Return what the constructor makes of a text that is known to be one: launch files have thousands."""
    made = _new(TextSubstitution)
    made._known_as = text if type(text) is str else None
    made._TextSubstitution__text = text  # type: ignore[attr-defined] # its own, by the name that it has outside
    return made

"""`launch.frontend.parse_substitution`: from texts with `$(...)` to substitutions."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.frontend.calls import class_of_call
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.place import here
from orchestra.compat.seam import connection
from orchestra.dataclass import dataclass
from orchestra.description.source import Written
from orchestra.description.text import Call, Opaque, Words
from orchestra.location import Span, point

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.description.text import Part, Template

_ESCAPED = re.compile(r"\\(.)")


@dataclass(frozen=True, slots=True)
class Given:
    """The place of what was made from a text: that of the text."""

    span: Span
    kind = None

    @property
    def file(self) -> str:
        """The file."""
        return self.span.file

    @property
    def whole(self) -> Span:
        """What names the file in which it stands; another object each time."""
        return point(self.span.file)

    def of(self, _made: object) -> Given:
        """Return the place of what is made anew there: the same."""
        return self

    def at(self, *_: Any) -> Span:
        """Return the place of an argument: the same."""
        return self.span


def parse_substitution(text: str) -> list[Substitution]:
    """Return the substitutions of a text, one empty text for an empty one. Raises `InvalidSubstitutionError`."""
    span = here().span
    return parse_written(Written(text, span, lambda _first, _last: span))


def parse_written(written: Written) -> list[Substitution]:
    """Return the same for a text whose place is known."""
    return substitutions_of(connection().front_end.template(written))


def parse_if_substitutions(
    value: Any,
    parse: Callable[[str], list[Substitution]] = parse_substitution,
) -> Any:
    """Return a value with its texts as substitutions where they have any; a list must then be of one type.

    Raises `ValueError` where it is not.
    """
    if isinstance(value, str):
        return _if_any(parse(value))
    if not isinstance(value, list):
        return value
    items = [_if_any(parse(item)) if isinstance(item, str) else item for item in value]
    if len({type(item) for item in items if not isinstance(item, list)}) > 1:
        raise ValueError(f"the values of a list are of one type: {value!r}")
    return items


def replace_escaped_characters(text: str) -> str:
    """Return a text without the backslashes that escape something."""
    return _ESCAPED.sub(r"\1", text)


def substitutions_of(template: Template) -> list[Substitution]:
    """Return the substitutions of a template."""
    return [_substitution(part) for part in template.parts] or [TextSubstitution(text="")]


def _if_any(found: list[Substitution]) -> Any:
    """Return the text where there is nothing to substitute."""
    texts = [item.text for item in found if type(item) is TextSubstitution]
    return "".join(texts) if len(texts) == len(found) else found


def _substitution(part: Part) -> Substitution:
    match part:
        case Words(text):
            return TextSubstitution(text=text)
        case Opaque(target):
            return target  # type: ignore[no-any-return]  # what a third party's class has made
        case Call(name, arguments, span):
            return called(class_of_call(name).parse, [substitutions_of(item) for item in arguments], span)


def called(parse: Any, arguments: list[list[Substitution]], span: Span) -> Substitution:
    """Return the substitution that a parse method and its arguments give."""
    kind, keywords = parse(arguments)
    made: Any = kind(**keywords)
    made._place = Given(span)
    return made  # type: ignore[no-any-return]  # a substitution

"""Text with substitutions, as the loaders read it: every part knows where it stands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Self, TypeAlias

from orchestra.dataclass import dataclass, maker
from orchestra.location import Span
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterable


@dataclass(frozen=True, slots=True)
class Words:
    """A piece of literal text, escapes already taken away."""

    text: str
    span: Span


@dataclass(frozen=True, slots=True)
class Call:
    """One substitution, `$(name argument ...)`; the span covers it from the dollar to the closing parenthesis."""

    name: str
    arguments: tuple[Template, ...]
    span: Span


@dataclass(frozen=True, slots=True, eq=False)
class Opaque:
    """A substitution that only its object in a Python launch file can perform.

    `inside` are the texts that it is known to be made of.
    """

    target: Any
    span: Span
    inside: tuple[Template, ...] = ()


Part: TypeAlias = Words | Call | Opaque


@dataclass(frozen=True, slots=True)
class Template:
    """A value as written: its parts are concatenated when it is evaluated.

    `raw` is the text as written (after the file format's own quoting). `quoted` says that the user's format marks it
    as a string (a YAML scalar in quotes), which keeps a text without substitutions from being read as a number.
    `faulty` marks a value whose fault has been reported already: it evaluates to poison.
    """

    parts: tuple[Part, ...]
    raw: str
    span: Span
    quoted: bool = False
    faulty: bool = False

    @property
    def action(self) -> Any:  # noqa: ANN401 - any object
        """The action of a Python launch file that stands where a name could, None where a text does."""
        match self.parts:
            case (Opaque(target=target),) if not hasattr(target, "perform"):
                return target
        return None

    @property
    def constant(self) -> str | None:
        """The text where nothing needs evaluating, else None."""
        if self.faulty:
            return None
        texts = []
        for part in self.parts:
            if type(part) is not Words:
                return None
            texts.append(part.text)
        return "".join(texts)


@dataclass(frozen=True, slots=True)
class Constant:
    """A value that has its type already, as Python's `1e-6`, `True` or `'text'`: it is used as it is.

    A list may still be one whose items have several types.
    """

    value: ParameterValue
    span: Span


# What the loaders, and code, make thousands of.
new_constant = maker(Constant)
new_words = maker(Words)
new_call = maker(Call)
new_template = maker(Template)


class Items(tuple[Template, ...]):  # noqa: SLOT001 - a tuple has no room for slots
    """A list as it is written in a file, which knows where it stands."""

    span: Span

    def __new__(cls, items: Iterable[Template], span: Span) -> Self:
        """Return the list that stands at a place."""
        made = super().__new__(cls, items)
        made.span = span
        return made


def span_of(value: Template | Constant | tuple[Template | Constant, ...]) -> Span | None:
    """Return where a value begins, None for an empty list of Python code."""
    if isinstance(value, tuple) and value:
        return value[0].span
    return value.span if isinstance(value, Items | Template | Constant) else None


def whole_span_of(value: tuple[Template | Constant, ...]) -> Span | None:
    """Return the place to point at for a list: all of one on one line, else what it begins with."""
    if not isinstance(value, Items):
        return span_of(value)
    span = value.span
    if span.line == span.end_line:
        return span
    return Span(span.file, span.line, span.column, span.line, span.column + 1)


def raw_of(value: Template | tuple[Template, ...]) -> str:
    """Return a value as written, the items of a list with blanks between them."""
    return " ".join(item.raw for item in value) if isinstance(value, tuple) else value.raw

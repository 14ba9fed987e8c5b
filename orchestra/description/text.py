"""Text with substitutions, as the loaders read it: every part knows where it stands."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

from orchestra.location import Span


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


Part: TypeAlias = Words | Call


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
    def constant(self) -> str | None:
        """The text where nothing needs evaluating, else None."""
        if self.faulty or any(isinstance(part, Call) for part in self.parts):
            return None
        return "".join(part.text for part in self.parts if isinstance(part, Words))

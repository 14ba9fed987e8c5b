"""What holds inside of an action, because its condition is true."""

from __future__ import annotations

from typing import TypeAlias

from orchestra.dataclass import dataclass
from orchestra.location import Location
from orchestra.resolve.context import Evaluated

# A text as far as comparing goes: its constant words, and the names and arguments of its substitutions.
Form: TypeAlias = tuple["str | tuple[str, tuple[Form, ...]]", ...]


@dataclass(frozen=True, slots=True)
class Held:
    """A text that is true, or false.

    `compared` is the constant that a text is equal to, for a condition that compares. `values` are those of the
    variables in it when it was evaluated; `file` and `chain` tell where.
    """

    form: Form
    truth: bool
    compared: str | None
    values: tuple[tuple[str, Evaluated | None], ...]
    location: Location

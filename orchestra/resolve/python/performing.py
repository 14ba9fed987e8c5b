"""Performs substitutions that only Python code can."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.resolve.context import POISON, Evaluated, Value
from orchestra.resolve.python.calling import user_code

if TYPE_CHECKING:
    from orchestra.description.text import Opaque
    from orchestra.resolve.resolution import Resolution


def perform_opaque(part: Opaque, run: Resolution) -> Evaluated:
    """Return the text of a user's substitution. What it raises is reported, and so is anything but a text."""
    text: object = None
    context = run.engine.context
    with user_code(run, part.span):
        text = part.target.perform(context)
        if not isinstance(text, str):
            raise TypeError(f"{type(part.target).__name__}.perform returns a text, not {text!r}")
    return Value(text, run.at(part.span)) if isinstance(text, str) else POISON

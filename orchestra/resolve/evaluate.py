"""Turns a text with substitutions into its value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import Opaque, Words
from orchestra.resolve.context import POISON, Poison, new_location, new_value
from orchestra.resolve.substitutions.table import SUBSTITUTIONS

if TYPE_CHECKING:
    from orchestra.description.text import Call, Template
    from orchestra.resolve.context import Context, Evaluated


def evaluate(template: Template, context: Context) -> Evaluated:
    """Return the concatenated parts; the value points at where the template is written.

    Every part is evaluated even where one is faulty, so that all faults are reported and all reads are seen.
    """
    parts = template.parts
    if len(parts) == 1 and type(parts[0]) is Words and not template.faulty:
        return new_value(parts[0].text, new_location(template.span, context.included_from), verbatim=True)
    constant = template.constant if len(parts) != 1 else None
    if constant is not None and not template.faulty:
        return new_value(constant, context.at(template.span), verbatim=True)
    texts: list[str] = []
    poisoned = template.faulty
    with context.variables.tracing() as reads:
        for part in parts:
            if isinstance(part, Words):
                texts.append(part.text)
                continue
            value = perform(part, context)
            if isinstance(value, Poison):
                poisoned = True
            else:
                texts.append(value.text)
    if poisoned:
        return POISON
    return new_value("".join(texts), context.at(template.span), through=tuple(reads), raw=template.raw)


def perform(part: Call | Opaque, context: Context) -> Evaluated:
    """Return the value of one substitution, which points at where the substitution is written."""
    if isinstance(part, Opaque):
        return context.perform_opaque(part)
    return SUBSTITUTIONS[part.name](part, context, evaluate)

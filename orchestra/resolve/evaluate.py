"""Turns a text with substitutions into its value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.description.text import MatchedTemplate, Opaque, Words
from orchestra.resolve.context import POISON, Poison, new_value
from orchestra.resolve.substitutions.table import SUBSTITUTIONS

if TYPE_CHECKING:
    from orchestra.description.text import Call, Template
    from orchestra.resolve.context import Context, Evaluated


def evaluate(template: Template, context: Context) -> Evaluated:
    """Return the concatenated parts; the value points at where the template is written.

    Every part is evaluated even where one is faulty, so that all faults are reported and all reads are seen.
    """
    if type(template) is MatchedTemplate:
        return _matched(template, context)
    parts = template.parts
    if len(parts) == 1 and type(parts[0]) is Words and not template.faulty:
        return new_value(parts[0].text, context.at(template.span), verbatim=True)
    constant = template.constant if len(parts) != 1 else None
    if constant is not None and not template.faulty:
        return new_value(constant, context.at(template.span), verbatim=True)
    return _concatenated(template, context)


def _concatenated(template: Template, context: Context) -> Evaluated:
    texts: list[str] = []
    poisoned = template.faulty
    with context.variables.tracing() as reads:
        for part in template.parts:
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
    return new_value("".join(texts), context.place(template), through=tuple(reads), raw=template.raw)


def _matched(template: MatchedTemplate, context: Context) -> Evaluated:
    """Return what a text comes to whose calls are variables without anything to tell of, without their places."""
    text = template.constant
    if text is not None:
        return new_value(text, context.place(template), verbatim=True)
    pieces = template.pieces
    known = None if pieces is None or pieces.variables is None else context.variables.known(pieces.variables)
    if pieces is None or known is None:
        return _concatenated(template, context)
    texts, reads = known
    return new_value(pieces.filled(texts), context.place(template), through=reads, raw=template.raw)


def perform(part: Call | Opaque, context: Context) -> Evaluated:
    """Return the value of one substitution, which points at where the substitution is written."""
    if isinstance(part, Opaque):
        return context.perform_opaque(part)
    return SUBSTITUTIONS[part.name](part, context, evaluate)

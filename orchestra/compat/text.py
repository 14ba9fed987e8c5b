"""Substitutions as Python launch files write them, and the templates they turn into.

`SomeSubstitutionsType` is a text, a substitution, or an iterable of both, which are concatenated.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.wrong import WrongType
from orchestra.description.text import Template

if TYPE_CHECKING:
    from orchestra.location import Span

Sub: TypeAlias = str | Substitution | Iterable[str | Substitution]


def normalized(subs: Sub) -> list[Substitution]:
    """Return a list of substitutions. Raises `TypeError` for anything else, as upstream."""
    if isinstance(subs, str):
        return [TextSubstitution(text=subs)]
    if isinstance(subs, Substitution):
        return [subs]
    if not isinstance(subs, Iterable):
        raise WrongType(_wrong(subs), subs)
    return [_one(item) for item in subs]


def template(subs: Sub, span: Span, *, quoted: bool = False) -> Template:
    """Return the template of some substitutions; those without a place of their own are at `span`."""
    try:
        items = normalized(subs)
    except WrongType as error:
        raise WrongType(str(error), error.value, at=span) from None
    parts = tuple(part for item in items for part in item._parts(span))
    if len(parts) == 1:
        span = parts[0].span
    raw = "".join(item._raw() for item in items)
    return Template(parts, raw, span, quoted=quoted)


def _one(item: Any) -> Substitution:
    if isinstance(item, str):
        return TextSubstitution(text=item)
    if isinstance(item, Substitution):
        return item
    raise WrongType(_wrong(item), item)


def _wrong(value: object) -> str:
    return (
        f"expected a text or a substitution (or several in a list), found {type(value).__name__}: {value!r}"
    )

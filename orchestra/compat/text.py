"""Substitutions as Python launch files write them, and the templates they turn into.

`SomeSubstitutionsType` is a text, a substitution, or an iterable of both, which are concatenated.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution, text_of
from orchestra.compat.place import Argument, Arguments, Place
from orchestra.compat.wrong import WrongType
from orchestra.description.text import matched_words, new_template, new_words
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from orchestra.description.text import Part, Template
    from orchestra.location import Span

Sub: TypeAlias = str | Substitution | Iterable[str | Substitution]

_SERIES: Final = frozenset({list, tuple})


def normalized(subs: Sub) -> list[Substitution]:
    """Return a list of substitutions. Raises `TypeError` for anything else, as upstream."""
    if isinstance(subs, str):
        return [text_of(subs)]
    if isinstance(subs, Substitution):
        return [subs]
    if type(subs) is not list and (not isinstance(subs, Iterable) or _is_unordered(subs)):
        raise WrongType(_wrong(subs), subs)
    return [item if isinstance(item, Substitution) else _one(item) for item in subs]


def template(subs: Sub, span: Span, *, quoted: bool = False) -> Template:
    """Return the template of some substitutions; those without a place of their own are at `span`."""
    if type(subs) in _SERIES and len(subs) == 1 and type(subs[0]) is TextSubstitution:  # type: ignore[arg-type,index] # as it says
        subs = subs[0].text  # type: ignore[index] # as above
    if type(subs) is str:
        if type(span) is Argument and "$" not in subs and "\\" not in subs:
            place, path = span.place, span.path
            if (
                type(place) is Place and path
            ):  # the same, of which words and place are made when somebody asks
                return matched_words(subs, quoted, Arguments(place), path)  # type: ignore[arg-type] # its groups are paths
        return new_template((new_words(subs, span),) if subs else (), escaped(subs), span, quoted)
    items = _items(subs, span)
    parts: tuple[Part, ...] = ()
    raw = ""
    for item in items:
        whole = item._whole()
        if whole is None:
            parts += item._parts(span)
            raw += item._raw()
        elif len(items) == 1 and not quoted:
            return whole
        else:
            parts += whole.parts
            raw += whole.raw
    if len(parts) == 1:
        span = parts[0].span
    return new_template(parts, raw, span, quoted)


def _items(subs: Sub, span: Span) -> Sequence[Substitution]:
    """Return substitutions: a list of them, which constructors keep, as it is."""
    if type(subs) is list:
        for item in subs:
            if not isinstance(item, Substitution):
                break
        else:
            return subs
    try:
        return normalized(subs)
    except WrongType as error:
        raise WrongType(str(error), error.value, at=span) from None


def _is_unordered(subs: Any) -> bool:
    """Return whether several things have no order in which they could be joined, or have names."""
    return isinstance(subs, Mapping) or (isinstance(subs, AbstractSet) and len(subs) > 1)


def _one(item: Any) -> Substitution:
    if isinstance(item, str):
        return text_of(item)
    raise WrongType(_wrong(item), item)


def _wrong(value: object) -> str:
    return (
        f"expected a text or a substitution (or several in a list), found {type(value).__name__}: {value!r}"
    )

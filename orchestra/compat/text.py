"""Substitutions as Python launch files write them, and the templates they turn into.

`SomeSubstitutionsType` is a text, a substitution, or an iterable of both, which are concatenated.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from operator import attrgetter
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution, text_of
from orchestra.compat.place import Argument, Arguments, Place
from orchestra.compat.wrong import WrongType
from orchestra.dataclass import dataclass, maker
from orchestra.description.text import (
    Pieces,
    PlainCall,
    PlainPath,
    matched_template,
    matched_words,
    new_template,
    new_words,
)
from orchestra.description.written import escaped
from orchestra.location import Matched

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.compat.place import Instructions, Way
    from orchestra.description.text import MatchedTemplate, Part, Template
    from orchestra.location import Span

Sub: TypeAlias = str | Substitution | Iterable[str | Substitution]

_SERIES: Final = frozenset({list, tuple})
_SEVERAL: Final = 2
_MOST: Final = 4096
_VARIABLE, _PATH = "var", "path-join"
LIST: Final = ""  # what several are known by as one component of a path, in the place of a name
# Kinds of substitutions with what performs them: where that is still so, no code of launch files does.
performing: Final[dict[type[Substitution], Any]] = {}
# These kinds, and texts, which are known as themselves.
kinds: Final[set[type[Any]]] = {str, TextSubstitution}
# How often something that is known as itself has been shown to code, which may change it from then on.
shown: Final = [0]
_perform: Final = attrgetter("perform")


@dataclass(frozen=True, slots=True)
class Composed(Pieces):
    """Texts and substitutions that code has put together, and how that is written; where, the match knows.

    There is one for all that are given alike. `packages` are those whose places are in it, by the name of the call.
    """

    raw: str = ""
    packages: tuple[tuple[str, str], ...] = ()

    def placed_in(self, template: MatchedTemplate) -> tuple[Part, ...]:
        """Return them as parts of a text."""
        parts: tuple[Part, ...] = template.matched.parts(template.span)  # type: ignore[attr-defined] # one with `parts`
        return parts


new_composed: Final = maker(Composed)


# By what they are known as; None for several that are left to those who look at each.
_composed: Final[dict[tuple[Any, ...], Composed | None]] = {}
_alone: Final[dict[tuple[Any, ...], Composed]] = {}


class Listed(Matched):
    """Several texts and substitutions that stand in an argument of a call."""

    __slots__ = ("_call", "_items")

    def __init__(self, call: Arguments, items: Sequence[Any]) -> None:
        self._call = call
        self._items = tuple(items)

    @property
    def whole(self) -> Instructions:  # type: ignore[override] # nobody sets it
        """The text, as that of the call."""
        return self._call.whole

    def span(self, group: Any) -> Span:
        """Return the place of the argument, by its path."""
        return self._call.span(group)

    def parts(self, span: Span) -> tuple[Part, ...]:
        """Return them as parts of a text that stands there."""
        return joined(self._items, span)[0]


def joined(items: Iterable[Any], span: Span) -> tuple[tuple[Part, ...], str]:
    """Return texts and substitutions as the parts of a text at a place, and how it is written."""
    parts: tuple[Part, ...] = ()
    raw = ""
    for item in items:
        text = item.text if type(item) is TextSubstitution else item
        if type(text) is str:
            parts += (new_words(text, span),) if text else ()
            raw += escaped(text)
            continue
        whole = item._whole()
        if whole is None:
            parts += item._parts(span)
            raw += item._raw()
        else:
            parts += whole.parts
            raw += whole.raw
    return parts, raw


def known_as(items: Sequence[Any]) -> tuple[Any, ...] | None:
    """Return what several texts and substitutions are known as; None where one is of another kind."""
    found: list[Any] = []
    for item in items:  # one by one, which is done sooner than types and attributes are mapped
        kind = type(item)
        if kind is str:
            found.append(item)
        elif kind in kinds:
            found.append(item._known_as)
        else:
            return None
    return tuple(found)


def perform_alike(*alike: type[Substitution]) -> None:
    """Take note of kinds of substitutions that are all alike where the same was given."""
    performing.update((kind, kind.perform) for kind in alike)
    kinds.update(alike)


def performs(kind: type[Substitution]) -> None:
    """Take note of what performs a kind of substitutions, which code may replace."""
    performing.setdefault(kind, kind.perform)


def is_changed() -> bool:
    """Return whether code has put something else in the place of what performs substitutions."""
    return [*map(_perform, performing)] != [*performing.values()]


def composed(
    items: Sequence[Any], call: Arguments, path: tuple[Way, ...], *, quoted: bool = False
) -> Template | None:
    """Return several texts and substitutions that stand in an argument of a call; None where that takes a look."""
    known = known_as(items)
    if known is None:
        return None
    found = _composed.get(known)
    if found is None and known not in _composed:
        if len(_composed) >= _MOST:
            _composed.clear()
        if not _is_plain(known):
            found = _composed_of(known, joined(items, call.place.span)[1])
        _composed[known] = found
    if found is None or is_changed():
        return None
    return matched_template(found.raw, quoted, Listed(call, items), path, found)  # type: ignore[arg-type] # its groups are paths


def alone(known: tuple[Any, ...], raw: Callable[[], str]) -> Composed:
    """Return what a substitution alone is, which is known as this and written like that."""
    found = _alone.get(known)
    if found is None:
        if len(_alone) >= _MOST:
            _alone.clear()
        found = _alone[known] = _composed_of((known,), raw())
    return found


def _is_plain(known: tuple[Any, ...]) -> bool:
    """Return whether several items are one, or texts alone, or where that takes a look."""
    return len(known) < _SEVERAL or None in known or "" in known or all(type(item) is str for item in known)


def _composed_of(known: Iterable[Any], raw: str) -> Composed:
    """Return what is made of items, by what they are known as."""
    names: list[str] = []
    packages: list[tuple[str, str]] = []
    pieces = _pieces(known, names, packages)
    others = [piece for piece in pieces if type(piece) is not str]
    is_of_variables = all(type(piece) is PlainCall and piece.variable is not None for piece in others)
    variables, beside = (tuple(names), None) if is_of_variables else (None, tuple(names))
    return Composed(pieces, variables, beside, raw, tuple(packages))


def _pieces(known: Iterable[Any], names: list[str], packages: list[tuple[str, str]]) -> tuple[Any, ...]:
    found: list[Any] = []
    for item in known:
        if type(item) is str:
            found.append(item)
            continue
        name, *arguments = item
        if name == _PATH:
            components = [
                each[1:] if type(each) is tuple and each[0] == LIST else (each,) for each in arguments
            ]
            found.append(PlainPath(tuple([_pieces(each, names, packages) for each in components])))
            continue
        if name == _VARIABLE:
            names.append(arguments[0])
        elif arguments:
            packages.append((name, arguments[0]))
        found.append(PlainCall(name, (), 0, arguments[0] if name == _VARIABLE else None))
    return tuple(found)


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
    if type(span) is Argument and type(span.place) is Place and span.path:
        made = composed(items, Arguments(span.place), span.path, quoted=quoted)
        if made is not None:
            return made
    whole = items[0]._whole() if len(items) == 1 and not quoted else None
    if whole is not None:
        return whole
    parts, raw = joined(items, span)
    return new_template(parts, raw, parts[0].span if len(parts) == 1 else span, quoted)


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

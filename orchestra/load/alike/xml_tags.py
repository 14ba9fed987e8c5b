"""Actions in XML as nearly all are: tags with attributes, of texts that mean the same to every reader of XML.

What an element means is told by the model that it belongs to, as in `xml_file`. One expression tells a tag. What is
between the values of its attributes, its name among it, is looked up, for in a launch file few tags differ in that.
Anything that is not plain to see takes a parser.
"""

from __future__ import annotations

import re
from functools import cache, partial
from itertools import count, islice
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.description.entity import Entity
from orchestra.description.source import Written
from orchestra.description.text import matched_words
from orchestra.load.alike.learned import UnlikeError
from orchestra.load.alike.making import template
from orchestra.load.alike.straight import Model, Read, Way, action_model, how
from orchestra.load.elements import spans_in
from orchestra.load.forms import Kind, forms_of
from orchestra.location import Matched, Span, stretch

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.description.entity import Action
    from orchestra.load.offsets import Source
    from orchestra.load.reader import Reader

_DEEPEST: Final = 20
_BLANK: Final = r"[ \t\r\n]"
# With what stands for characters that would mean something else, as expressions have it.
_NAMED: Final = r"&(?:quot|apos|lt|gt|amp);"
_DOUBLE: Final = rf'"(?:[ !#-%\'-;=-~]++|{_NAMED})*+"'
_SINGLE: Final = rf"'(?:[ -%(-;=-~]++|{_NAMED})*+'"
# Such as have neither calls nor escapes in them, are not empty and end with no quote.
_WORDS: Final = r"""\"[ !#%')-;=-[\]-~]++(?<!')\""""
_KEY: Final = rf"{_BLANK}++[A-Za-z_][A-Za-z0-9_.-]*+{_BLANK}*+={_BLANK}*+"
_COMMENT: Final = r"<!--(?:(?!--)[\t\r\n -~\xa0-\xff])*+-->"
_NAME: Final = "[A-Za-z][A-Za-z0-9_-]*+"
_CLOSED: Final = rf"{_BLANK}*+/?+"
# What stands in a tag: with attributes of words, or none, or what it closes; with others in double quotes; with any.
_TAG: Final = re.compile(
    rf"(?:{_BLANK}++|{_COMMENT})*+(?:<(?:({_NAME}(?:{_KEY}{_WORDS})*+{_CLOSED}|/{_NAME}{_BLANK}*+)>"
    rf"|({_NAME}(?:{_KEY}{_DOUBLE})*+{_CLOSED})>|({_NAME}(?:{_KEY}(?:{_DOUBLE}|{_SINGLE}))*+{_CLOSED})>)|[^<]++|<)"
)
_VALUE: Final = re.compile(r"""[ \t\r\n]*+=[ \t\r\n]*+(?:"([^"]*+)"|'([^']*+)')""")
_QUOTED: Final = re.compile("""\"([^"]*+)\"|'([^']*+)'""")
_NAMES: Final = re.compile(r"[^ \t\r\n=/>]+")
_ENTITY: Final = re.compile("&([a-z]+);")
_CHARACTERS: Final = {"quot": '"', "apos": "'", "lt": "<", "gt": ">", "amp": "&"}
_CHILDREN: Final = "children"
_INSIDE: Final = 8  # bits of a number that tell what of a tag is meant: its name, or which of its attributes
_MOST: Final = (1 << _INSIDE) - 1
_MOST_KEPT: Final = 2_000

# What is between the values of a tag.
_Between: TypeAlias = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class _Shape:
    """What a tag says whose values stand between the same: the name of its element, and of which model that is.

    `fields` are those of its attributes, `reads` how these are read that are no mere `texts`. `part` is the field of
    the element around that it belongs to.
    """

    model: Model
    inside: _Inside | None
    name: str
    fields: tuple[str, ...]
    reads: tuple[Read | None, ...]
    texts: bool
    part: str


@dataclass(frozen=True, slots=True)
class _Inside:
    """What may stand in an element: parts, with their models and fields, and actions; and tags as seen so far.

    `single` are fields of parts of which there is one, `others` keys of its model that are no such parts.
    """

    parts: dict[str, tuple[type[Entity], str]]
    single: frozenset[str]
    others: frozenset[str]
    holds_actions: bool
    shapes: dict[_Between, _Shape]

    def put(self, found: dict[str, list[Any]], values: dict[str, Any]) -> None:
        """Add what has been found in such an element to its values."""
        if self.holds_actions and _CHILDREN not in found:
            raise UnlikeError
        for part, made in found.items():
            if part in values or (len(made) > 1 and part in self.single):
                raise UnlikeError
            values[part] = made[0] if part in self.single else tuple(made)

    def shape(self, between: _Between) -> _Shape:
        """Return what a tag says in such an element, and keep it. Raises `UnlikeError`."""
        name, *keys = _NAMES.findall(" ".join(between)) or ("",)
        part = self.parts.get(name)
        if part is None and (name in self.others or not self.holds_actions):
            raise UnlikeError
        model, field = (action_model(name), _CHILDREN) if part is None else (how(part[0]), part[1])
        forms, ways = forms_of(model.model), dict[str, Way]()
        for key in keys:
            if key not in forms.texts or len(ways) == _MOST:
                raise UnlikeError
            way = model.way(key, ways)
            ways[way.name] = way
        empty = between[-1].endswith("/")
        if empty and forms.holds_actions:
            raise UnlikeError
        reads = tuple(
            [None if key in model.texts else ways[own].read for key, own in zip(keys, ways, strict=True)]
        )
        inside = None if empty else _inside(model.model)
        shape = _Shape(model, inside, name, tuple(ways), reads, not any(reads), field)
        if len(self.shapes) < _MOST_KEPT:
            self.shapes[between] = shape
        return shape


@cache
def _inside(model: type[Entity]) -> _Inside:
    ways, forms, parts, single = how(model).ways, forms_of(model), {}, set[str]()
    for key, form in forms.by_key.items():
        way = ways[key]
        if way.model is not None and way.model is form.model and not form.or_variables:
            parts[key] = way.model, way.name
            if form.kind is not Kind.PARTS:
                single.add(way.name)
    others = frozenset(forms.by_key.keys() - parts)
    return _Inside(parts, frozenset(single), others, forms.holds_actions, {})


_ROOT: Final = _Inside({}, frozenset(), frozenset(), holds_actions=True, shapes={})


class _Tags(Matched):
    """Where tags and what is in them stand: a number tells the tag, and in its last bits which attribute, if any."""

    __slots__ = ("_begin", "_tags", "_text")

    def __init__(self, whole: Source, begin: int) -> None:
        self.whole = whole
        self._spans = {}
        self._text, self._begin = whole.text, begin
        self._tags: list[re.Match[str]] = []

    def span(self, group: int) -> Span:
        """Return the place with a number."""
        span = self._spans.get(group)
        if span is None:
            begin, end = self.value(group) if group & _MOST else self._name(group)
            span = self._spans[group] = stretch(self.whole, begin, end)
        return span

    def value(self, number: int) -> tuple[int, int]:
        """Return the offsets of an attribute's value, inside of its quotes."""
        pairs = _VALUE.finditer(self._text, self._name(number)[1])
        pair = next(islice(pairs, (number & _MOST) - 1, None))
        return pair.span(pair.lastindex or 0)

    def _name(self, number: int) -> tuple[int, int]:
        """Return the offsets of the name of a tag."""
        at = number >> _INSIDE
        if at >= len(self._tags):
            self._tags = list(islice(_TAG.finditer(self._text, self._begin), 2 * at + 1))
        tag = self._tags[at]
        begin = tag.start(tag.lastindex or 0)
        return begin, _NAMES.match(self._text, begin).end()  # type: ignore[union-attr]  # a tag has a name


def read(whole: Source, begin: int, reader: Reader) -> tuple[Action, tuple[_Between, ...], int] | None:
    """Return the action that is the element at an offset, what tells its form, and the offset behind it.

    None where it takes a parser, or a closer look.
    """
    scan, values = _Scan(whole, begin, reader), dict[str, Any]()
    try:
        scan.content(_ROOT, None, values, 0)
    except UnlikeError:
        return None
    return values[_CHILDREN][0], tuple(scan.words), scan.end


class _Scan:
    """Goes through tags; `end` is the offset behind the last one. `words` is what they have looked like."""

    __slots__ = ("around", "end", "places", "reader", "tags", "whole", "words")

    def __init__(self, whole: Source, begin: int, reader: Reader) -> None:
        self.whole = whole
        self.reader = reader
        self.tags: Iterator[tuple[int, re.Match[str]]] = enumerate(_TAG.finditer(whole.text, begin))
        self.end = begin
        self.around = stretch(whole, begin, begin)
        self.places = _Tags(whole, begin)
        self.words: list[_Between] = []

    def content(self, inside: _Inside, name: str | None, values: dict[str, Any], depth: int) -> None:
        """Add what stands in an element to its values, up to the tag that closes it; without a name, one element."""
        if depth > _DEEPEST:
            raise UnlikeError
        shapes, words = inside.shapes, self.words
        found: dict[str, list[Any]] = {}
        for number, tag in self.tags:
            plain, double, other = tag.groups()
            pieces = (plain or double or "").split('"') if other is None else _pieces(other)
            between = tuple(pieces[::2])
            shape = shapes.get(between)
            if shape is None:
                if pieces[0][:1] == "/":
                    break
                shape = inside.shape(between)
            words.append(between)
            made = self.entity(shape, plain is not None, pieces[1::2], number << _INSIDE, depth)
            if shape.part in found:
                found[shape.part].append(made)
            else:
                found[shape.part] = [made]
            if name is None:
                break
        else:
            raise UnlikeError
        if name is not None and pieces[0][1:].rstrip() != name:
            raise UnlikeError
        self.end = max(self.end, tag.end())
        inside.put(found, values)

    def entity(self, shape: _Shape, plain: bool, texts: Sequence[str], head: int, depth: int) -> Any:  # noqa: ANN401 - an entity
        """Return what an element says, whose start tag has these values; `plain` if these are words."""
        places = self.places
        if plain and shape.texts:
            values: dict[str, Any] = {
                field: matched_words(text, False, places, at)
                for field, text, at in zip(shape.fields, texts, count(head + 1))
            }
        else:
            values, reader = {}, self.reader
            for field, read, text, at in zip(shape.fields, shape.reads, texts, count(head + 1)):
                if "&" in text:
                    written = self.named(text, at)
                    values[field] = (
                        reader.template(written) if read is None else read(written, places, reader)
                    )
                elif read is None:
                    values[field] = template(text, places, at, False, reader)
                else:
                    values[field] = read((text, at, False), places, reader)
        if shape.inside is None:
            return shape.model.made(values, places, head, shape.fields)
        self.content(shape.inside, shape.name, values, depth + 1)
        return shape.model.made(values, places, head)

    def named(self, text: str, at: int) -> Written:
        """Return the value of an attribute in which something stands for other characters."""
        value = _ENTITY.sub(_character, text)
        return Written(value, self.around, spans_in(self.whole, partial(self.places.value, at)))


def _character(named: re.Match[str]) -> str:
    return _CHARACTERS[named[1]]


def _pieces(pairs: str) -> list[str]:
    """Return the values in a tag, and what is between them, in turn."""
    pieces = _QUOTED.split(pairs)
    return [piece for piece in pieces if piece is not None]

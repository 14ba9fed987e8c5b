"""From what a file says, in its plainest form, straight to the entities that it means.

Models read values of every kind, and tell what is wrong with them. Where nothing is wrong, and nearly all is text, it
takes a sixth of that time to go by what the annotations of their fields say. Whatever is not plain to see here is left
to the ordinary way, which gives the same.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Container, Mapping
from enum import Enum, auto
from functools import cache, partial
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Annotated, Any, Final, TypeAlias, Union, get_args, get_origin

from orchestra.dataclass import dataclass
from orchestra.description.actions import model_of
from orchestra.description.core import PydanticCustomError, ValidationError
from orchestra.description.entity import Action, Entity, set_beside, set_values
from orchestra.description.fields import AnyValue, Argv, Literal, Text
from orchestra.description.marks import Instance, NotEmpty, Plain, Told
from orchestra.description.source import Written
from orchestra.description.text import Items, matched_words
from orchestra.load.alike.learned import UnlikeError
from orchestra.load.alike.making import literal, template
from orchestra.load.keys import spelled

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.load.reader import Reader
    from orchestra.location import Matched, Places

# A text, the number of its place, and whether it is in quotes. One with escapes in it is `Written`.
Scalar: TypeAlias = tuple[str, int, bool]


class Keys:
    """A mapping: its values by their keys, and the number of the place of what introduces it."""

    __slots__ = ("head", "values")

    def __init__(self, values: dict[str, Any], head: int) -> None:
        self.values = values
        self.head = head


class Series:
    """A list, the number of its place, and that of what introduces it; `bare` if there are but literal words in it."""

    __slots__ = ("at", "bare", "head", "items")

    def __init__(self, items: list[Any], at: int, head: int, *, bare: bool = False) -> None:
        self.items = items
        self.bare = bare
        self.at = at
        self.head = head


Read: TypeAlias = Callable[[Any, Any, "Reader"], Any]


_MOST_KEPT: Final = 2_000
_new = object.__new__


class Kind(Enum):
    """What stands behind a key, as far as it is told by the model what is in it."""

    PART = auto()  # an entity
    PARTS = auto()  # a list of entities
    ACTIONS = auto()
    OTHER = auto()


@dataclass(frozen=True, slots=True)
class Way:
    """How what stands behind a key is read, for which field; `model` is that of the parts where they have one."""

    name: str
    read: Read
    kind: Kind
    model: type[Entity] | None


@dataclass(frozen=True, slots=True)
class Model:
    """How a model is read: its fields where nothing is written, and what reads them, by keys.

    `texts` are the fields of texts by their keys, `required` those that must be, `parts` those of one entity. `fit` has
    sets of fields, without such parts, that do not contradict each other.
    """

    model: type[Entity]
    unwritten: dict[str, Any]
    ways: Mapping[str, Way]
    texts: Mapping[str, str]
    required: frozenset[str]
    parts: frozenset[str]
    fit: set[Collection[str]]

    def way(self, key: str, beside: Container[str]) -> Way:
        """Return how a key is read, which may be spelled with `-`; `beside` are the fields that are written before.

        Raises `UnlikeError` where there is no such key, or where its field is written already.
        """
        way = self.ways.get(key) or self.ways.get(spelled(key))
        if way is None or way.name in beside:
            raise UnlikeError
        return way

    def made(
        self, values: dict[str, Any], places: Matched, head: int, together: tuple[str, ...] | None = None
    ) -> Any:  # noqa: ANN401 - an entity
        """Return the entity with these values of fields, which stands at a place; `together` are the fields, if known.

        Raises `UnlikeError` where it lacks one, or has some that cannot stand together.
        """
        entity: Any = _new(self.model)
        set_values(entity, self.unwritten | values)
        set_beside(entity, {"span": None, "at": (places, head)})
        if together is None:
            together = tuple(values)
        if together not in self.fit:
            self._check(entity, together)
        return entity

    def _check(self, entity: Entity, together: tuple[str, ...]) -> None:
        """Refuse an entity that lacks a field, or has some that cannot stand together, in whatever order."""
        unordered = frozenset(together)
        if unordered not in self.fit:
            if not self.required <= unordered or entity.conflict() is not None:
                raise UnlikeError
            if not self.parts.isdisjoint(together):
                return
            self.fit.add(unordered)
        if len(self.fit) < _MOST_KEPT:
            self.fit.add(together)


def action_model(name: str) -> Model:
    """Return how an action is read that is called so. Raises `UnlikeError` where there is none."""
    model = model_of(spelled(name))
    if model is None:
        raise UnlikeError
    return how(model)


def read_action(written: Any, places: Places, reader: Reader) -> Action:  # noqa: ANN401 - a tree
    """Return the action that is a mapping with its name as the only key. Raises `UnlikeError`."""
    if type(written) is not Keys or len(written.values) != 1:
        raise UnlikeError
    ((name, content),) = written.values.items()
    model = action_model(name)
    if type(content) is Series:
        content = Keys({"children": content}, content.head)
    action: Action = _entity(model.model, content, places, reader)
    return action


def _entity(model: type[Entity], written: Any, places: Places, reader: Reader) -> Any:  # noqa: ANN401 - a tree, an entity
    if type(written) is not Keys:
        raise UnlikeError
    known = how(model)
    values: dict[str, Any] = {}
    for key, value in written.values.items():
        way = known.way(key, values)
        values[way.name] = way.read(value, places, reader)
    return known.made(values, places, written.head)


@cache
def how(model: type[Entity]) -> Model:
    """Return how a model is read."""
    entries = model.model_fields
    unwritten = {name: None if entry.is_required() else entry.default for name, entry in entries.items()}
    ways = {entry.alias or name: _way(name, entry.annotation) for name, entry in entries.items()}
    texts = {key: way.name for key, way in ways.items() if way.read in (_text, _text_or_list)}
    parts = frozenset(way.name for way in ways.values() if way.kind is Kind.PART)
    required = frozenset(ways[key].name for key in model.required_keys())
    return Model(model, unwritten, ways, texts, required, parts, set())


def _way(name: str, annotation: Any) -> Way:  # noqa: ANN401 - a type
    read = _reading(annotation)
    function: Any = getattr(read, "func", None)
    given: Any = getattr(read, "args", (None,))
    if function is _entity:
        return Way(name, read, Kind.PART, given[0])
    if function is _items and given[0] is read_action:
        return Way(name, read, Kind.ACTIONS, None)
    if function is _items and getattr(given[0], "func", None) is _entity:
        return Way(name, read, Kind.PARTS, given[0].args[0])
    return Way(name, read, Kind.OTHER, None)


def _reading(annotation: Any) -> Read:  # noqa: ANN401 - a type
    """Return what reads values of a type; what refuses all of them for one that takes a closer look."""
    origin, inner = get_origin(annotation), get_args(annotation)
    if origin in (Union, UnionType):
        present = [item for item in inner if item is not NoneType]
        return _reading(present[0]) if len(present) == 1 else _refused
    if origin is Annotated:
        return _marked(inner[0], inner[1:])
    if origin is tuple:
        return partial(_items, _reading(inner[0]))
    if isinstance(annotation, type) and issubclass(annotation, Entity):
        return partial(_entity, annotation)
    return _refused


def _marked(source: Any, marks: tuple[Any, ...]) -> Read:  # noqa: ANN401 - a type, and marks
    for mark in marks:
        if isinstance(mark, Plain):
            return _WAYS.get(mark.read) or partial(_checked, mark.read)
        if isinstance(mark, Instance):
            return read_action if source is Action else _refused
        if not isinstance(mark, Told | NotEmpty):  # no list is empty here
            return _refused
    return _reading(source)


def _refused(written: Any, places: Places, reader: Reader) -> Any:  # noqa: ANN401 - a tree
    del written, places, reader
    raise UnlikeError


def _text(written: Any, places: Places, reader: Reader) -> Any:  # noqa: ANN401 - a tree, a text
    if type(written) is not tuple:
        return _escaped(written, reader)
    text, at, quoted = written
    return template(text, places, at, quoted, reader)


def _escaped(written: Any, reader: Reader) -> Template:  # noqa: ANN401 - a tree
    """Return a text that does not stand in the file as it reads."""
    if type(written) is not Written:
        raise UnlikeError
    return reader.template(written)


def _literal(written: Any, places: Places, reader: Reader) -> Any:  # noqa: ANN401 - as above
    if type(written) is not tuple:
        raise UnlikeError
    text, at, quoted = written
    return literal(text, places, at, quoted, reader)


def _text_or_list(written: Any, places: Places, reader: Reader) -> Any:  # noqa: ANN401 - as above
    if type(written) is tuple:
        text, at, quoted = written
        return template(text, places, at, quoted, reader)
    if type(written) is not Series:
        return _escaped(written, reader)
    if written.bare:
        words = [matched_words(text, False, places, at) for text, at, _ in written.items]
        return Items(words, places.span(written.at))
    return Items([_text(item, places, reader) for item in written.items], places.span(written.at))


def _checked(read: Callable[[Any, Any], Any], written: Any, places: Places, reader: Reader) -> Any:  # noqa: ANN401 - as above
    """Return a text of which a model says what it may come to."""
    try:
        return read(_text(written, places, reader), None)
    except (PydanticCustomError, ValidationError):
        raise UnlikeError from None


def _items(read: Read, written: Any, places: Places, reader: Reader) -> tuple[Any, ...]:  # noqa: ANN401 - as above
    if type(written) is not Series:
        raise UnlikeError
    return tuple([read(item, places, reader) for item in written.items])


def _reads(annotation: Any) -> Any:  # noqa: ANN401 - a type, a function
    return next(mark.read for mark in get_args(annotation) if isinstance(mark, Plain))


_WAYS: Final[dict[Any, Read]] = {
    _reads(Text): _text,
    _reads(Literal): _literal,
    _reads(Argv): _text_or_list,
    _reads(AnyValue): _text_or_list,
}

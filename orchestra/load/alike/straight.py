"""From what a file says, in its plainest form, straight to the entities that it means.

Models read values of every kind, and tell what is wrong with them. Where nothing is wrong, and nearly all is text, it
takes a sixth of that time to go by what the annotations of their fields say. Whatever is not plain to see here is left
to the ordinary way, which gives the same.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Annotated, Any, Final, TypeAlias, Union, get_args, get_origin

from orchestra.dataclass import dataclass
from orchestra.description.actions import model_of
from orchestra.description.core import PydanticCustomError, ValidationError
from orchestra.description.entity import Action, Entity, matched_entity
from orchestra.description.fields import AnyValue, Argv, Literal, Text
from orchestra.description.marks import Instance, NotEmpty, Plain, Told
from orchestra.description.source import Written
from orchestra.description.text import Items
from orchestra.load.alike.learned import UnlikeError
from orchestra.load.alike.making import literal, template
from orchestra.load.keys import spelled
from orchestra.location import Places

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.load.reader import Reader

# A text, the number of its place, and whether it is in quotes. One with escapes in it is `Written`.
Scalar: TypeAlias = tuple[str, int, bool]


class Keys:
    """A mapping: its values by their keys, and the number of the place of what introduces it."""

    __slots__ = ("head", "values")

    def __init__(self, values: dict[str, Any], head: int) -> None:
        self.values = values
        self.head = head


class Series:
    """A list, the number of its place, and that of what introduces it."""

    __slots__ = ("at", "head", "items")

    def __init__(self, items: list[Any], at: int, head: int) -> None:
        self.items = items
        self.at = at
        self.head = head


@dataclass(frozen=True, slots=True)
class Plainly:
    """What one action is written as: a mapping with its name as the only key; and the places that it is made of.

    `words` tells its form: they are the same for actions that are written alike.
    """

    content: Keys
    places: Places
    words: tuple[str, ...]


_Read: TypeAlias = Callable[[Any, Places, "Reader"], Any]


@dataclass(frozen=True, slots=True)
class _Model:
    """How a model is read: its fields where nothing is written, by key what reads them, and the keys that must be.

    `texts` are the keys of texts, `parts` those of entities. `fit` has sets of keys, without such parts, that do not
    contradict each other.
    """

    unwritten: dict[str, Any]
    fields: Mapping[str, tuple[str, _Read]]
    required: frozenset[str]
    texts: frozenset[str]
    parts: frozenset[str]
    fit: set[tuple[str, ...]]


def straight(plainly: Plainly, reader: Reader) -> Action | None:
    """Return the action; None where it takes a closer look."""
    try:
        return _action(plainly.content, plainly.places, reader)
    except UnlikeError:
        return None


def _action(written: Any, places: Places, reader: Reader) -> Action:  # noqa: ANN401 - a tree
    if type(written) is not Keys or len(written.values) != 1:
        raise UnlikeError
    ((name, content),) = written.values.items()
    model = model_of(spelled(name))
    if model is None:
        raise UnlikeError
    if type(content) is Series:
        content = Keys({"children": content}, content.head)
    action: Action = _entity(model, content, places, reader)
    return action


def _entity(model: type[Entity], written: Any, places: Places, reader: Reader) -> Any:  # noqa: ANN401 - a tree, an entity
    if type(written) is not Keys:
        raise UnlikeError
    how = _how(model)
    values, fields, texts, keys = how.unwritten.copy(), how.fields, how.texts, written.values
    for key, value in keys.items():
        if key in texts and type(value) is tuple:
            text, at, quoted = value
            values[fields[key][0]] = template(text, places, at, quoted, reader)
            continue
        name, read = fields.get(key) or _field(key, fields, keys)
        values[name] = read(value, places, reader)
    entity = matched_entity(model, values, places, written.head)
    together = tuple(keys)
    if together not in how.fit:
        _check(entity, together, how)
    return entity


def _check(entity: Entity, together: tuple[str, ...], how: _Model) -> None:
    """Refuse an entity that lacks a key, or has some that cannot stand together."""
    if not how.required <= set(together) or entity.conflict() is not None:
        raise UnlikeError
    if how.parts.isdisjoint(together):
        how.fit.add(together)


def _field(key: str, fields: Mapping[str, Any], beside: Mapping[str, Any]) -> Any:  # noqa: ANN401 - a name and a function
    """Return the field of a key with `-` in it, as it is spelled otherwise."""
    name = spelled(key)
    if name in beside or name not in fields or sum(spelled(other) == name for other in beside) > 1:
        raise UnlikeError
    return fields[name]


@cache
def _how(model: type[Entity]) -> _Model:
    entries = model.model_fields
    unwritten = {name: None if entry.is_required() else entry.default for name, entry in entries.items()}
    fields = {entry.alias or name: (name, _reading(entry.annotation)) for name, entry in entries.items()}
    texts = frozenset(key for key, (_, read) in fields.items() if read in (_text, _text_or_list))
    parts = frozenset(key for key, (_, read) in fields.items() if getattr(read, "func", None) is _entity)
    return _Model(unwritten, fields, model.required_keys(), texts, parts, set())


def _reading(annotation: Any) -> _Read:  # noqa: ANN401 - a type
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


def _marked(source: Any, marks: tuple[Any, ...]) -> _Read:  # noqa: ANN401 - a type, and marks
    for mark in marks:
        if isinstance(mark, Plain):
            return _WAYS.get(mark.read) or partial(_checked, mark.read)
        if isinstance(mark, Instance):
            return _action if source is Action else _refused
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
    return Items([_text(item, places, reader) for item in written.items], places.span(written.at))


def _checked(read: Callable[[Any, Any], Any], written: Any, places: Places, reader: Reader) -> Any:  # noqa: ANN401 - as above
    """Return a text of which a model says what it may come to."""
    try:
        return read(_text(written, places, reader), None)
    except (PydanticCustomError, ValidationError):
        raise UnlikeError from None


def _items(read: _Read, written: Any, places: Places, reader: Reader) -> tuple[Any, ...]:  # noqa: ANN401 - as above
    if type(written) is not Series:
        raise UnlikeError
    return tuple([read(item, places, reader) for item in written.items])


def _reads(annotation: Any) -> Any:  # noqa: ANN401 - a type, a function
    return next(mark.read for mark in get_args(annotation) if isinstance(mark, Plain))


_WAYS: Final[dict[Any, _Read]] = {
    _reads(Text): _text,
    _reads(Literal): _literal,
    _reads(Argv): _text_or_list,
    _reads(AnyValue): _text_or_list,
}

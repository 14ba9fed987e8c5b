"""Descriptions without their places and spelling, to compare what two files say."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.convert.argv import split, words_of
from orchestra.convert.kinds import Kind, key_of, kind_of
from orchestra.convert.remarks import UnsayableError
from orchestra.convert.texts import normal
from orchestra.convert.typed import meaning, type_word
from orchestra.description.actions.set_parameter import SetParameter
from orchestra.description.entity import Entity
from orchestra.description.fields import FALSE_WORDS, TRUE_WORDS
from orchestra.description.parts import Override, Param
from orchestra.description.text import Constant, Template

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from orchestra.description.launch import Description

# Keys that say the same as others do, and defaults that may as well be said.
# Lists of pairs in which the last one with a name counts.
_LAST_COUNTS = frozenset({"env", "env_only", "keep"})
_SAME_LISTS = {"let": "arg", "choice": "choices"}
_DEFAULTS: Final[Mapping[Any, Any]] = {
    "allow_substs": False,
    "autostart": False,
    "cancel_on_shutdown": True,
    "forwarding": True,
    "prepend": False,
    "respawn": False,
    "respawn_max_retries": -1.0,
    "separator": ":",
    "shell": False,
    ("Group", "scoped"): True,
    ("Log", "level"): "info",
}
_WITHOUT_QUOTES = "extra_arg"  # a key in which quotes of YAML make no text
_TYPED = (Param, SetParameter)
_FOR_EACH = "for_each"


def said(description: Description) -> tuple[Any, ...]:
    """Return what a description says."""
    reason = description.deprecated
    return (None if reason is None else reason.constant, tuple(map(_entity, description.actions)))


def difference(one: Any, other: Any, way: str = "") -> str | None:  # noqa: ANN401 - a part of a description, whatever it is
    """Return where two descriptions differ first, and how; None where they say the same."""
    if one == other:
        return None
    if isinstance(one, tuple) and isinstance(other, tuple) and len(one) == len(other):
        pairs = (
            difference(*both, f"{way}.{index}") for index, both in enumerate(zip(one, other, strict=True))
        )
        return next((found for found in pairs if found is not None), None)
    if isinstance(one, dict) and isinstance(other, dict) and one.keys() == other.keys():
        found_in = (difference(one[key], other[key], f"{way}.{key}") for key in one)
        return next((found for found in found_in if found is not None), None)
    return f"at {way.lstrip('.') or 'the top'}: {one!r} has become {other!r}"


def _entity(entity: Entity, *, quotes: bool = True) -> tuple[str, dict[str, Any]]:
    model = Param if isinstance(entity, Override) else type(entity)
    quotes = quotes and not isinstance(entity, SetParameter)
    found: dict[str, Any] = {}
    for field in type(entity).model_fields:
        value = getattr(entity, field)
        if value is None or (value == () and field != "value"):
            continue
        read = _field(entity, field, value, quotes=quotes and field != _WITHOUT_QUOTES)
        if read == _default(model, field) or (field == "type" and issubclass(model, _TYPED)):
            continue  # a default, or a part of what the value means
        key = key_of(model, field)
        if field in _SAME_LISTS:
            found[_SAME_LISTS[field]] = (*found.get(_SAME_LISTS[field], ()), *_flat(read))
        else:
            found[key] = (*found[key], *read) if key in found else read
    return (model.__name__, found)


def _default(model: type[Entity], field: str) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    """Return what a key says that may as well be left out."""
    return _DEFAULTS.get((model.__name__, field), _DEFAULTS.get(field))


def _flat(items: Iterable[Any]) -> Iterable[Any]:
    for item in items:
        yield item[1]["value"] if item[0] == "Choice" else item


def _field(entity: Entity, field: str, value: Any, *, quotes: bool) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    if field == _FOR_EACH:
        return tuple((name, _repeated(item)) for name, item in value.items())
    kind = kind_of(type(entity), field)
    if kind is Kind.VALUE:
        word = type_word(entity.type) if isinstance(entity, _TYPED) else None
        return meaning(value, word, quotes=quotes)
    if kind is Kind.ARGV:
        return _command(value)
    if field == "launch_prefix":
        return _prefix(value)
    if field in _LAST_COUNTS:
        return tuple({normal(pair.name): normal(pair.value) for pair in value}.items())
    return _value(value, kind, quotes=quotes)


def _value(value: Any, kind: Kind, *, quotes: bool = True) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    if isinstance(value, Entity):
        return _entity(value, quotes=quotes)
    if isinstance(value, dict):
        return {name: tuple(sorted(_value(items, Kind.WORD))) for name, items in value.items()}
    if isinstance(value, tuple) and value and isinstance(value[0], Param):
        return tuple(found for item in value for found in _params(item, (), quotes=quotes))
    if isinstance(value, tuple):
        return tuple(_value(item, kind, quotes=quotes) for item in value)
    if not isinstance(value, Template):
        return repr(value)
    return _text(value, kind)


def _params(param: Param, above: tuple[Any, ...], *, quotes: bool) -> Iterator[Any]:
    """Yield parameters by their whole names, however they are nested."""
    name = None if param.name is None else (*above, *normal(param.name))
    if param.param is not None and name is not None:
        for inner in param.param:
            yield from _params(inner, (*name, "."), quotes=quotes)
        return
    _, said_of_it = _entity(param, quotes=quotes)
    yield (
        None if name is None else _merged(name),
        {key: item for key, item in said_of_it.items() if key != "name"},
    )


def _merged(parts: tuple[Any, ...]) -> tuple[Any, ...]:
    found: list[Any] = []
    for part in parts:
        if isinstance(part, str) and found and isinstance(found[-1], str):
            found[-1] += part
        else:
            found.append(part)
    return tuple(found)


def _text(template: Template, kind: Kind) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    constant = template.constant
    if constant is None or kind in (Kind.TEXT, Kind.LITERAL):
        return normal(template) if constant is None else constant
    word = constant.strip().lower()
    if kind is Kind.FLAG and word in TRUE_WORDS | FALSE_WORDS:
        return word in TRUE_WORDS
    try:
        return float(constant)
    except ValueError:
        return constant


def _command(argv: Template | tuple[Template, ...]) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    try:
        return tuple(map(normal, words_of(argv)))
    except UnsayableError:
        return ("faulty", tuple(map(normal, argv if isinstance(argv, tuple) else (argv,))))


def _prefix(prefix: Template | tuple[Template, ...]) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    texts = prefix if isinstance(prefix, tuple) else (prefix,)
    constants = [text.constant for text in texts]
    if None in constants:
        return ("list" if isinstance(prefix, tuple) else "text", tuple(map(normal, texts)))
    if isinstance(prefix, tuple):
        return tuple(constants)
    try:
        return tuple(split(str(constants[0])))
    except ValueError:
        return ("faulty", constants[0])


def _repeated(value: Any) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    """Return the values of a repetition: a text stands for a list with commas."""
    if isinstance(value, tuple):
        return tuple(map(_repeated_item, value))
    if isinstance(value, Constant) or value.constant is None:
        return _repeated_item(value)
    words = (word.strip() for word in value.constant.strip("[] ").split(","))
    return tuple(word.strip("'\"") for word in words if word)


def _repeated_item(value: Any) -> Any:  # noqa: ANN401 - a part of a description, whatever it is
    if isinstance(value, Constant):
        return str(value.value)
    return normal(value) if value.constant is None else value.constant

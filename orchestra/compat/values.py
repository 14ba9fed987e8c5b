"""Values of Python launch files as the models take them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from collections.abc import Set as AbstractSet
from typing import TYPE_CHECKING, Any

from orchestra.compat.explanation import told
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.place import Key, ValueOf, within
from orchestra.compat.text import Sub, template
from orchestra.compat.wrong import WrongType
from orchestra.description.parts import Pair

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.location import Span


def written(value: Any) -> Sub:
    """Return a value as substitutions: numbers and truth values as they are written in a launch file."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, int | float) else value


def scalar(value: Any, span: Span) -> Template:
    """Return the template of a number, a truth value, or substitutions."""
    return template(written(value), span)


def optional(value: Any, span: Span) -> Template | None:
    """Return the same, None for None."""
    return None if value is None else scalar(value, span)


def words(given: Any, name: str) -> list[Any]:
    """Return the words of a command line as a list. Raises `TypeError` for one text, which is not taken apart."""
    if isinstance(given, str | Substitution | Mapping | AbstractSet) or not isinstance(given, Iterable):
        raise TypeError(
            f"{name} is a list of words, not {told(given) if isinstance(given, AbstractSet) else repr(given)}"
        )
    return list(given)


def pairs(items: Iterable[tuple[Sub, Sub]], span: Span) -> tuple[Pair, ...]:
    """Return names with their values. Raises `TypeError` for anything else."""
    return tuple(_pair(item, span, index) for index, item in enumerate(items))


def _pair(item: tuple[Sub, Sub], span: Span, index: int) -> Pair:
    try:
        name, value = item
    except (TypeError, ValueError):
        told_so = f"a name and its value are expected, not {item!r}: ('name', 'value')"
        raise WrongType(told_so, item, at=within(span, index)) from None
    try:
        at, value_at = within(span, Key(index)), within(span, ValueOf(index))
        return Pair.made(span, {"name": template(name, at), "value": template(value, value_at)})
    except TypeError as error:
        told_so = f"{name if isinstance(name, str) else 'a name'}: {error}"
        raise WrongType(told_so, value, at=within(span, ValueOf(index))) from None


def output_field(output: Any, span: Span) -> Any:
    """Return where the output goes: a word, or places by stream."""
    if not isinstance(output, dict):
        return template(output, span)
    made = {stream: _places(places, within(span, stream)) for stream, places in output.items()}
    return made or {"both": ()}  # without any it goes nowhere


def _places(places: Any, span: Span) -> Any:
    words = [places] if isinstance(places, str) else sorted(places)
    return tuple(template(word, span) for word in words)

"""Texts of the usual kinds in the arguments of launch files, as parts of models."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final, TypeAlias

from orchestra.compat.calls import CallSubstitution
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.text import Listed, joined, known_as
from orchestra.compat.text import composed as several
from orchestra.description.model import Model
from orchestra.description.text import (
    MatchedTemplate,
    Pieces,
    Template,
    matched_template,
    matched_words,
    new_template,
    new_words,
)
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from orchestra.compat.place import Arguments, Way
    from orchestra.description.text import Part
    from orchestra.location import Span


# How often a substitution has been read of which nobody notes whether code is shown what it was given.
unnoted: Final = [0]


class UnusualError(Exception):
    """An argument is none of the usual ones."""


# What reads an argument into fields; where that is a text, the field.
Reader: TypeAlias = "Callable[[str, Any, Arguments, dict[str, Any], dict[str, Any]], None]"
Readers: TypeAlias = "Mapping[str, Reader | str]"


def read(
    given: dict[str, Any], call: Arguments, readers: Readers, fields: dict[str, Any]
) -> dict[str, Any] | None:
    """Read the keywords of a call into the fields of a model, which are all there, each as it is unwritten.

    Return the keywords with lists and dictionaries of their own; None where one is not usual.
    """
    kept = given.copy()
    try:
        for name, value in given.items():
            if value is None:
                if name not in _OPTIONAL:
                    return None
                continue
            reader = readers[name]
            if not isinstance(reader, str):
                reader(name, value, call, fields, kept)
            elif (
                type(value) is str and "$" not in value and "\\" not in value
            ):  # as `plain_text` does, at once
                fields[reader] = matched_words(value, False, call, (name,))  # type: ignore[arg-type] # its groups are paths
            else:
                word(reader, name, value, call, fields, kept)
    except (KeyError, UnusualError):
        return None
    return kept


def word(
    field: str, name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]
) -> None:
    """Read a text into a field."""
    fields[field] = plain_text(value, call, (name,))
    if type(value) is list:
        kept[name] = list(value)


def left(name: str, value: Any, call: Arguments, fields: dict[str, Any], kept: dict[str, Any]) -> None:
    """Leave an argument to the visit, as a condition is."""


def whole_text(value: Any) -> Template:
    """Return the text that a substitution alone is."""
    made = value._whole() if isinstance(value, CallSubstitution) else None
    if made is None:
        raise UnusualError
    if value._known_as is None and not value._is_noted():
        unnoted[0] += 1
    return made


def plain_text(value: Any, call: Arguments, path: tuple[Way, ...]) -> Template:
    """Return a text, a substitution, or several of both, which an argument of a call holds."""
    kind = type(value)
    if kind is TextSubstitution:
        value, kind = value.text, str
    if kind is str and "$" not in value and "\\" not in value:
        return matched_words(value, False, call, path)  # type: ignore[arg-type] # its groups are paths
    if kind is str:
        return divisible(value, call.span(path))
    if kind is list or kind is tuple:
        return composed(value, call, path)
    return whole_text(value)


def divisible(text: str, span: Span) -> Template:
    """Return a text that may be taken apart: its words know where they stand."""
    return new_template((new_words(text, span),) if text else (), escaped(text), span)


def composed(items: Any, call: Arguments, path: tuple[Way, ...]) -> Template:
    """Return several texts and substitutions as one, which an argument of a call holds."""
    made = of_variables(items, call, path) or several(items, call, path)
    if made is not None:
        return made
    if len(items) == 1 and type(items[0]) is not str and type(items[0]) is not TextSubstitution:
        return whole_text(items[0])
    span = call.span(path)
    for item in items:
        if type(item) is not str and type(item) is not TextSubstitution:
            whole_text(item)
    parts, raw = joined(items, span)
    return new_template(parts, raw, parts[0].span if len(parts) == 1 else span)


class Mixed(Listed):
    """Texts and variables in an argument of a call: what is concatenated, and what knows where that stands, in one."""

    __slots__ = ("pieces", "variables")

    pieces: tuple[Any, ...]
    variables: tuple[str, ...]
    beside = None
    filled = Pieces.filled  # which asks for the two above

    def placed_in(self, template: MatchedTemplate) -> tuple[Part, ...]:
        """Return them as parts of a text."""
        return self.parts(template.span)


def mixed(
    raw: str,
    pieces: tuple[Any, ...],
    variables: tuple[str, ...],
    items: tuple[Any, ...],
    call: Arguments,
    path: tuple[Way, ...],
) -> Template:
    """Return several texts and variables as the text that an argument of a call holds."""
    made: Any = _new(Mixed)
    made._call = call
    made._items = items
    made.pieces = pieces
    made.variables = variables
    return matched_template(raw, False, made, path, made)  # type: ignore[arg-type] # its groups are paths


def of_variables(items: Any, call: Arguments, path: tuple[Way, ...]) -> Template | None:
    """Return the same of texts and variables, with at least one of these; None for others."""
    known = known_as(items)
    if known is None or len(known) < _SEVERAL:
        return None
    raw = ""
    pieces: tuple[Any, ...] = ()
    names: tuple[str, ...] = ()
    for item, said in zip(items, known, strict=True):
        if type(said) is str and said:
            raw += escaped(said)
            pieces += (said,)
        elif type(said) is tuple and said[0] == _VARIABLE:
            whole = item._whole()
            if type(whole) is not MatchedTemplate or whole is not item._sure or whole.pieces is None:
                return None
            raw += whole.raw
            pieces += whole.pieces.pieces
            names += whole.pieces.variables or ()
        else:
            return None
    return mixed(raw, pieces, names, tuple(items), call, path) if names else None


def copied(value: Any) -> Any:
    """Return a list, or what is in a tuple, so that nobody else changes it."""
    kind = type(value)
    if kind is list:
        return [copied(item) if type(item) in _SERIES else item for item in value]
    return tuple([copied(item) for item in value]) if kind is tuple else value


def entity(kind: type[Any], values: dict[str, Any], beside: dict[str, Any]) -> Any:
    """Return what `Entity.made` makes of all of the fields. What is `beside` may be so for several parts."""
    made = _new(kind)
    _set_values(made, values)
    _set_beside(made, beside)
    return made


def standing_at(call: Arguments, path: tuple[Way, ...], origin: Any = None) -> dict[str, Any]:
    """Return what is beside the fields of what an argument of a call holds, or of the call, without a path."""
    return {"span": None, "at": (call, path), "origin": origin}


# Keywords that say nothing by None.
_OPTIONAL: Final = frozenset(
    {"package", "name", "namespace", "exec_name", "parameters", "remappings", "arguments", "ros_arguments"}
    | {"output", "prefix", "cwd", "additional_env", "condition", "emulate_tty", "respawn_delay", "on_exit"}
    | {"extra_arguments", "sigterm_timeout", "sigkill_timeout"}
)
_SERIES: Final = frozenset({list, tuple})
_SEVERAL: Final = 2
_VARIABLE: Final = "var"
_new = object.__new__
_set_beside: Final[Callable[[Any, dict[str, Any]], None]] = vars(Model)["__pydantic_private__"].__set__
_set_values: Final[Callable[[Any, dict[str, Any]], None]] = vars(Model)["__dict__"].__set__

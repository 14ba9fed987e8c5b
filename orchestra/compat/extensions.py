"""Keys that Orchestra adds to actions, as keywords of Python: plain values, read as the same keys of a YAML file are.

`depends_on` takes actions too: every process that comes out of one is waited for. A text is never read for `$(...)`:
substitutions are objects. Where a text is wanted, a list of texts and substitutions is one, as everywhere.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import PurePath
from signal import Signals
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.launch.substitution import Substitution
from orchestra.compat.seam import connection
from orchestra.compat.text import template
from orchestra.compat.values import written
from orchestra.description.source import Keyed, Listed, Written
from orchestra.description.text import Constant, Opaque, Template
from orchestra.description.written import escaped

if TYPE_CHECKING:
    from orchestra.compat.literals import Literal
    from orchestra.compat.place import Place
    from orchestra.description.entity import Entity

RUNNING: Final = (
    *("depends_on", "ready", "alive", "restart", "required", "stop", "success_exit_codes"),
    *("stdin", "limits", "warm"),
)
INCLUDED: Final = ("for_each", "scoped", "label", "depends_on")


def taken(keywords: dict[str, Any], names: Iterable[str]) -> dict[str, Any]:
    """Take keywords out of others, those without a value too; return those that have one."""
    found = {name: keywords.pop(name) for name in names if name in keywords}
    return {name: _lasting(value) for name, value in found.items() if value is not None}


def extension_fields(
    kind: type[Entity], given: Mapping[str, Any], place: Place, **needed: Any
) -> dict[str, Any]:
    """Return the fields of a model for such keywords, and the `faults` that are in them.

    `needed` are fields that the model cannot be without.
    """
    if not given:
        return {}
    # Here, because few launch files have such keywords, and what it imports.
    from orchestra.compat.literals import keyword  # noqa: PLC0415

    mapping = Keyed(place.span, place.span)
    for name, value in given.items():
        at = keyword(place, name)
        mapping.put(name, _TREES.get(name, _text)(value, at), at.span)
    entity, faults = connection().front_end.entity(kind, mapping, needed)
    known = {name: getattr(entity, name) for name in given}
    return {**known, "faults": faults}


def _lasting(value: Any) -> Any:
    """Return a value that can be read more than once, as a model is made at each visit."""
    if isinstance(value, Mapping):
        return {key: _lasting(item) for key, item in value.items()}
    return list(value) if isinstance(value, Iterator) else value


def _part(**trees: Callable[[Any, Literal], Any]) -> Callable[[Any, Literal], Any]:
    """Return a reader of mappings: with texts in them but for the keys that are named."""

    def read(value: Any, at: Literal) -> Any:
        if not isinstance(value, Mapping):
            return _texts(value, at)
        found = Keyed(at.span, at.span)
        for key, item in value.items():
            name = str(key)
            found.put(name, trees.get(name, _text)(item, at.value(key)), at.key(key))
        return found

    return read


def _typed(value: Any, at: Literal) -> Any:
    """Return the value of a parameter, which has its type already unless it is made of substitutions."""
    if isinstance(value, bool | int | float | str):
        return Constant(value, at.span)
    if isinstance(value, list | tuple) and all(isinstance(item, bool | int | float | str) for item in value):
        return Constant(tuple(value), at.span)
    return _text(value, at)


def _dependencies(value: Any, at: Literal) -> Any:
    return _listed(value, at, _dependency) if _is_list(value) else _text(value, at)


def _dependency(value: Any, at: Literal) -> Any:
    if isinstance(value, Mapping):
        return _keyed(value, at, _target)
    if not isinstance(value, LaunchDescriptionEntity):
        return _text(value, at)
    whole = Keyed(at.span, at.span)
    whole.put("process", _target(value, at), at.span)
    return whole


def _target(value: Any, at: Literal) -> Any:
    """Return a text, or the action that stands for one."""
    if not isinstance(value, LaunchDescriptionEntity):
        return _text(value, at)
    return Template((Opaque(value, at.span),), type(value).__name__, at.span)


def _texts(value: Any, at: Literal) -> Any:
    return _listed(value, at, _text) if _is_list(value) else _text(value, at)


def _repeated(value: Any, at: Literal) -> Any:
    return _keyed(value, at, _texts) if isinstance(value, Mapping) else _texts(value, at)


def _text(value: Any, at: Literal) -> Any:
    """Return a scalar; anything else as what it is, for a message that says what was found."""
    if value is None:
        return Written("", at.span, lambda *_: at.span, null=True)
    if isinstance(value, Mapping):
        return _keyed(value, at, _text)
    if isinstance(value, Signals):
        return _scalar(value.name, at)
    if isinstance(value, str | bool | int | float):
        return _scalar(str(written(value)), at)
    if isinstance(value, PurePath):
        return _scalar(str(value), at)
    if isinstance(value, Substitution) or _is_text(value):
        return template(value, at.span)
    return _listed(value, at, _text) if _is_list(value) else value


def _scalar(text: str, at: Literal) -> Written:
    return Written(escaped(text), at.span, lambda *_: at.span)


def _keyed(value: Mapping[Any, Any], at: Literal, inner: Any) -> Keyed:
    found = Keyed(at.span, at.span)
    for key, item in value.items():
        found.put(str(key), inner(item, at.value(key)), at.key(key))
    return found


def _listed(value: Iterable[Any], at: Literal, inner: Any) -> Listed:
    items = list(value)
    found = Listed(at.span)
    found += [inner(item, at.item(index, len(items))) for index, item in enumerate(items)]
    return found


def _is_list(value: Any) -> bool:
    return isinstance(value, Iterable) and not isinstance(value, str | bytes | Mapping)


def _is_text(value: Any) -> bool:
    """Return whether something is texts and substitutions that are concatenated."""
    return (
        isinstance(value, list | tuple)
        and bool(value)
        and all(isinstance(item, str | Substitution) for item in value)
    )


_TREES: Final = {
    "depends_on": _dependencies,
    "ready": _part(command=_texts, parameter=_part(value=_typed)),
    "alive": _part(command=_texts),
    "limits": _part(cores=_texts),
    "restart": _part(),
    "stop": _part(),
    "success_exit_codes": _texts,
    "for_each": _repeated,
}

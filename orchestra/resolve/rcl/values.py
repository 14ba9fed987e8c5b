"""From YAML events to values, as rcl's parser does it over libyaml."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.location import new_span
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.scalars import typed

if TYPE_CHECKING:
    from orchestra.location import Span
    from orchestra.values import Scalar

_STRING_TAG = "tag:yaml.org,2002:str"


def loader() -> Any:  # noqa: ANN401 - a class of PyYAML
    """Return libyaml where PyYAML has it, because that is what rcl reads with; its pure twin elsewhere."""
    return getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def scalar(event: yaml.ScalarEvent) -> Scalar:
    """Return the value of a scalar: text where it is quoted or tagged `!!str`, else as `typed`; no other tag counts.

    Raises `ValueError` where a value is missing.
    """
    quoted = event.style in ("'", '"')
    if not event.value and not quoted:
        raise ValueError("a value is missing")
    text = terminated(event.value)
    return text if quoted or event.tag == _STRING_TAG else typed(text)


def terminated(text: str) -> str:
    """Return the text up to its first NUL, where a C string ends."""
    return text.partition("\0")[0]


def span_of_events(first: yaml.Event, last: yaml.Event, file: str) -> Span:
    """Return the place from one event to another."""
    start, end = first.start_mark, last.end_mark
    assert start is not None  # noqa: S101 - events of a parser have marks
    assert end is not None  # noqa: S101
    unseen = isinstance(first, yaml.CollectionStartEvent) and start.index == end.index  # in block form
    return new_span(file, start.line + 1, start.column + 1, end.line + 1, end.column + 1 + unseen)


def odd_boolean(read: Scalar, event: yaml.ScalarEvent) -> tuple[str, ...]:
    """Return what is to be said of a word that hardly anybody means as a boolean."""
    if not isinstance(read, bool) or event.value.lower() in ("true", "false"):
        return ()
    return (f"'{event.value}' is read as {str(read).lower()} where it is not in quotes",)

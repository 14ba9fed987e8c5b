"""`-p` on a node's command line: `name:=value`, or `node:name:=value` for nodes of that name in the root."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.table import counting
from orchestra.resolve.rcl.values import loader, scalar
from orchestra.values import ParameterValue

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.values import Scalar

# What rcl's lexer takes for words: `__` begins no word, `___` stands in none; possessive, so that no name is slow.
_WORD = r"(?!__)[A-Za-z_](?:(?!___)[A-Za-z0-9_])*+"
_PART = rf"(?:/|{_WORD})++"
_NAME = pattern(rf"{_PART}(?:\.{_PART})*+")
_NODE = pattern(r"(?!__)[A-Za-z_](?:(?!__)[A-Za-z0-9_])*+")


@dataclass(frozen=True, slots=True)
class Override:
    """One `-p`: for the nodes that match the pattern. `value` is None where rcl has no type for it (`[]`)."""

    pattern: str
    name: str
    value: ParameterValue | None


def read_override(text: str) -> Override:
    """Read the word behind `-p`. Raises `ValueError` with the reason where rcl refuses it."""
    left, assigned, value = text.partition(":=")
    if not assigned:
        raise ValueError(f"'{text}' has no ':=' between name and value")
    node, colon, name = left.rpartition(":")
    if colon and not _NODE.fullmatch(node):
        raise ValueError(f"'{node}' is no name of a node; rcl takes no namespace here")
    if not _NAME.fullmatch(name):
        raise ValueError(f"rcl's command line does not take '{name}' as the name of a parameter")
    return Override(node if colon else "/**", name, override_value(value))


def override_value(text: str) -> ParameterValue | None:
    """Return the value of a `-p`. Raises `ValueError` with the reason where rcl refuses it."""
    if not text:
        raise ValueError("a value is missing behind ':='")
    try:
        return counting(_values(text))
    except yaml.YAMLError as error:
        raise ValueError(f"'{text}' is not YAML ({getattr(error, 'problem', error)})") from None


def _values(text: str) -> Iterator[ParameterValue]:
    """Yield the values of a text as rcl meets them: nested lists are flat to it, and each begins a new one."""
    items: list[Scalar] | None = None
    for event in yaml.parse(text, Loader=loader()):
        if isinstance(event, yaml.ScalarEvent):
            value = scalar(event)
            if items is None:
                yield value
                continue
            if items and type(items[0]) is not type(value):
                raise ValueError(f"a list must hold values of one type, not {items[0]!r} and {value!r}")
            items.append(value)
            continue
        if items and isinstance(event, yaml.SequenceStartEvent | yaml.SequenceEndEvent):
            yield tuple(items)  # type: ignore[misc] # of one type, as checked above
        if isinstance(event, yaml.SequenceStartEvent):
            items = []
        elif isinstance(event, yaml.SequenceEndEvent):
            items = None
        elif isinstance(event, yaml.MappingStartEvent | yaml.AliasEvent):
            word = "a mapping" if isinstance(event, yaml.MappingStartEvent) else "an alias"
            raise ValueError(f"'{text}' is {word}, which rcl does not take")  # noqa: TRY004

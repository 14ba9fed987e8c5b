"""The scalars of a text that holds one YAML value, by PyYAML's reading (YAML 1.1) and by the core schema of 1.2.

Most texts are read alike by both, and by rcl: they need no parser.
"""

from __future__ import annotations

from functools import cache, lru_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.description.source import shortened
from orchestra.description.text import MatchedTemplate
from orchestra.patterns import pattern
from orchestra.pyyaml import yaml
from orchestra.resolve.rcl.scalars import SLIPS

if TYPE_CHECKING:
    import re
    from collections.abc import Callable, Sequence
    from typing import TypeAlias

    from yaml.constructor import SafeConstructor

    from orchestra.description.text import Template
    from orchestra.values import ParameterValue, Scalar

    Construct: TypeAlias = Callable[[yaml.ScalarEvent], Any]

QUOTE: Final = "quote it to mean a text"

# In characters. Numbers of 64 bits are shorter, and Python takes time with the square of the length for longer ones.
_LONGEST_NUMBER: Final = 1_000
# Longer texts are left to libyaml, which is a hundred times as fast; PyYAML's own parser is the one upstream has.
_LONG: Final = 10_000
_NUMBERS: Final = ("tag:yaml.org,2002:int", "tag:yaml.org,2002:float")

# Texts that YAML 1.1, YAML 1.2 and rcl read alike, and of which there is nothing to tell: numbers that fit, true and
# false, addresses, texts in quotes, and words that mean nothing but themselves. What begins like a boolean or like no
# number may be a slip, or be one with brackets to rcl.
_INTEGER: Final = r"-?(?:0|[1-9][0-9]{0,17})"
_FLOAT: Final = rf"{_INTEGER}\.[0-9]{{1,18}}"
_NUMBER: Final = pattern(rf"{_INTEGER}(\.[0-9]{{1,18}})?")
_WORDS: Final = (
    r"(?!(?:[tT]rue|TRUE|[fF]alse|FALSE|[nN][aA][nN])\b)"
    r"""[A-Za-z_/](?:[!-9;-~]|:(?=[!-~])| ++(?!#)(?=[!-~])){0,500}"""
)
_OCTET: Final = r"(?:0|[1-9][0-9]{0,2})"
_IN_QUOTES: Final = r"""'([ -&(-~]*)'|"([ !#-\[\]-~]*)\""""
_TEXT: Final = pattern(
    rf"[A-Za-z_/][A-Za-z0-9_/.-]{{0,500}}|{_WORDS}|{_OCTET}(?:\.{_OCTET}){{3}}|{_IN_QUOTES}"
)
_BOOLEANS: Final = {"true": True, "false": False}
_MEANT: Final = frozenset(
    ["y", "yes", "n", "no", "on", "off", "true", "false", "null", "nan", "inf", "infinity", *SLIPS]
)
# A list of floats, of integers, of words, and one with items in quotes.
_BARE: Final = r"[A-Za-z0-9_/.-]+"
_QUOTED: Final = r"""'[ -&(-~]*'|"[ !#-\[\]-~]*\""""
_LIST: Final = pattern(
    rf"\[ *+(?:({_FLOAT}(?:, *+{_FLOAT})*)|({_INTEGER}(?:, *+{_INTEGER})*)|({_BARE}(?:, *+{_BARE})*)"
    rf"|((?:{_BARE}|{_QUOTED})(?:, *+(?:{_BARE}|{_QUOTED}))*)) *+\]"
)
_OF_FLOATS, _OF_INTEGERS, _OF_WORDS = 1, 2, 3
_ITEM: Final = pattern(rf"{_BARE}|{_QUOTED}")


class Plain(str):
    """A text that stands unquoted and without a tag."""

    __slots__ = ()


class NotYaml(ValueError):  # noqa: N818 - a reason, which problems and refusals tell
    """A text holds nothing that PyYAML can read, so that upstream has no value for it either."""


@lru_cache(maxsize=2048)  # of many parameters few say what no other does
def read_alike(text: str) -> Scalar | None:
    """Return what a text is to everybody who reads it, None where that is not plain to see."""
    number = _NUMBER.fullmatch(text)
    if number is not None:
        return int(text) if number[1] is None else float(text)
    if text in _BOOLEANS:
        return _BOOLEANS[text]
    found = _TEXT.fullmatch(text)
    if found is None or text.lower() in _MEANT:
        return None
    return text if found.lastindex is None else found[found.lastindex]


def value_alike(text: str) -> ParameterValue | None:
    """Return what a text is to everybody who reads it, also a list in brackets; None where that is not plain to see."""
    return _list_alike(text) if text[:1] == "[" else read_alike(text)


def items_alike(items: Sequence[Template]) -> ParameterValue | None:
    """Return what the items of a list in a file are to everybody, None where that takes a closer look."""
    values: list[Any] = []
    for item in items:
        if type(item) is not MatchedTemplate or not item.constant:
            return None
        values.append(item.constant if item.quoted else read_alike(item.constant))
    return tuple(values) if len(set(map(type, values))) == 1 and values[0] is not None else None


def _list_alike(text: str) -> ParameterValue | None:
    """Return what a list in brackets is to everybody who reads it, None where that is not plain to see."""
    listed = _LIST.fullmatch(text)
    if listed is None:
        return None
    kind: Any = listed.lastindex
    if kind == _OF_FLOATS:
        return tuple(map(float, listed[kind].split(",")))
    if kind == _OF_INTEGERS:
        return tuple(map(int, listed[kind].split(",")))
    words = listed[kind].split(",") if kind == _OF_WORDS else _ITEM.findall(listed[kind])
    items: list[Any] = [read_alike(word.strip(" ")) for word in words]
    return tuple(items) if len(set(map(type, items))) == 1 and items[0] is not None else None


def read_scalars(text: str, construct: Construct) -> Any:  # noqa: ANN401 - a scalar or a list
    """Return the scalar or the flat list of scalars that a text holds; None where it holds nothing.

    Raises `NotYaml`, or another `ValueError` with the reason: a mapping, a list of anything but scalars.
    """
    loader = yaml.SafeLoader if len(text) <= _LONG else getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        events = list(yaml.parse(text, Loader=loader))[2:-1]
    except yaml.YAMLError as error:
        reason = getattr(error, "problem", None) or str(error).partition("\n")[0]
        raise NotYaml(f"'{shortened(text)}' is not YAML ({reason}): {QUOTE}") from None
    if any(isinstance(event, yaml.DocumentStartEvent) for event in events):
        raise ValueError(f"'{shortened(text)}' holds more than one YAML document")
    if not events:
        return None
    first, *rest = events
    if isinstance(first, yaml.AliasEvent):
        raise NotYaml(f"'{shortened(text)}' is an alias without an anchor: {QUOTE}")
    if isinstance(first, yaml.ScalarEvent):
        return construct(first)
    if not isinstance(first, yaml.SequenceStartEvent):
        raise ValueError(f"'{shortened(text)}' is a mapping, which no parameter can be: {QUOTE}")  # noqa: TRY004
    return _items(rest[:-2], construct)


def _items(events: Sequence[yaml.Event], construct: Construct) -> list[Any]:
    named: dict[str, yaml.ScalarEvent] = {}
    items = []
    for event in events:
        scalar: yaml.Event | None = event
        if isinstance(event, yaml.AliasEvent):
            scalar = named.get(event.anchor or "")
            if scalar is None:
                raise ValueError(f"the alias '*{event.anchor}' has no anchor")
        if not isinstance(scalar, yaml.ScalarEvent):
            raise ValueError("a list of lists or mappings cannot be a parameter")  # noqa: TRY004
        if scalar.anchor is not None:
            named[scalar.anchor] = scalar
        items.append(construct(scalar))
    return items


def by_pyyaml(event: yaml.ScalarEvent) -> Any:  # noqa: ANN401 - what PyYAML makes of it
    """Return what `yaml.safe_load` makes of a scalar; plain text as `Plain`. Raises `ValueError`."""
    tag = event.tag
    if tag is None or tag == "!":
        tag = _resolver()(yaml.ScalarNode, event.value, event.implicit)
    if tag in _NUMBERS and len(event.value) > _LONGEST_NUMBER:
        raise ValueError(f"'{shortened(event.value)}' is too long for a number: {QUOTE}")
    try:
        value = _constructor().construct_object(yaml.ScalarNode(tag, event.value))
    # What PyYAML's constructors raise for a value that does not fit its tag, as in `!!bool perhaps`.
    except (yaml.YAMLError, ArithmeticError, LookupError, AttributeError):
        raise ValueError(f"'{shortened(event.value)}' means nothing as a parameter: {QUOTE}") from None
    return Plain(value) if isinstance(value, str) and event.implicit[0] else value


def by_core(event: yaml.ScalarEvent) -> Any:  # noqa: ANN401 - what YAML 1.2 makes of it
    """Return what the core schema of YAML 1.2 makes of a scalar. Raises `ValueError`."""
    if not event.implicit[0] or len(event.value) > _LONGEST_NUMBER:
        return by_pyyaml(event)
    return next((read(event.value) for form, read in _CORE if form.fullmatch(event.value)), event.value)


@cache
def _resolver() -> Callable[..., str]:
    return yaml.resolver.Resolver().resolve


@cache
def _constructor() -> SafeConstructor:
    return yaml.constructor.SafeConstructor()


# YAML 1.2.2, 10.3.2 "Tag Resolution" of the core schema.
_CORE: Final[tuple[tuple[re.Pattern[str], Callable[[str], Any]], ...]] = (
    (pattern(r"null|Null|NULL|~|"), lambda _: None),
    (pattern(r"true|True|TRUE|false|False|FALSE"), lambda text: text.lower() == "true"),
    (pattern(r"[-+]?[0-9]+"), int),
    (pattern(r"0o[0-7]+|0x[0-9a-fA-F]+"), lambda text: int(text, 0)),
    (pattern(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?"), float),
    (pattern(r"[-+]?\.(inf|Inf|INF)"), lambda text: float(text.replace(".", ""))),
    (pattern(r"\.(nan|NaN|NAN)"), lambda _: float("nan")),
)

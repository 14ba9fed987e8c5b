"""What a declaration demands of a value beyond its type; a rule tells what is wrong with a value."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.declared.texts import listed, nearest_text, shown
from orchestra.values import Scalar

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.values import ParameterValue

# How far a value may be from a whole number of steps, in steps: as rclcpp and rclpy are content.
_TOLERANCE = 1e-6


@dataclass(frozen=True, slots=True)
class Objection:
    """What is wrong with a value, as the end of a sentence; `meant` is what should stand there."""

    told: str
    meant: str | None = None
    item: int | None = None


@dataclass(frozen=True, slots=True)
class Range:
    """The least and the greatest value; `open_` where they themselves are too little or too great.

    With `step` a value is a whole number of steps above `low`, or `high`. `items`: it is about each item of a list.
    """

    low: float | None = None
    high: float | None = None
    open_low: bool = False
    open_high: bool = False
    step: float = 0
    items: bool = False


@dataclass(frozen=True, slots=True)
class OneOf:
    """The values that there are, for the whole or for each item of a list."""

    values: tuple[Scalar, ...]
    items: bool = False


@dataclass(frozen=True, slots=True)
class Size:
    """The least and the greatest number of items, or of characters; of `octets` where a program in C++ counts."""

    low: int | None = None
    high: int | None = None
    octets: bool = False


@dataclass(frozen=True, slots=True)
class Unique:
    """No item of a list is there twice."""


Rule: TypeAlias = Range | OneOf | Size | Unique


def objections(rule: Rule, value: ParameterValue) -> Iterator[Objection]:
    """Yield what is wrong with a value of a type that the rule is about; of others nothing is said."""
    match rule:
        case Range() | OneOf() if rule.items:
            if isinstance(value, tuple):
                yield from _of_items(rule, value)
        case Range():
            told = None if isinstance(value, tuple) else _out_of_range(rule, value)
            yield from () if told is None else (told,)
        case OneOf():
            told = _none_of(rule, value)
            yield from () if told is None else (told,)
        case Size():
            yield from _wrong_size(rule, value)
        case Unique():
            yield from _repeated(value)


def _of_items(rule: Range | OneOf, items: Sequence[Scalar]) -> Iterator[Objection]:
    for index, item in enumerate(items):
        told = _out_of_range(rule, item) if isinstance(rule, Range) else _none_of(rule, item)
        if told is not None:
            yield Objection(told.told, told.meant, index)


def _out_of_range(rule: Range, value: Scalar) -> Objection | None:
    if isinstance(value, bool | str) or value != value:  # noqa: PLR0124 - what is no number has no place in an order
        return None
    low, high = rule.low, rule.high
    below = low is not None and (value <= low if rule.open_low else value < low)
    above = high is not None and (value >= high if rule.open_high else value > high)
    if below or above:
        return Objection(f"must be {_bounds(rule)}, not {shown(value)}")
    if rule.step and low is not None and value != high and not _is_step(value - low, rule.step):
        return Objection(f"must be {shown(low)} and steps of {shown(rule.step)}, not {shown(value)}")
    return None


def _is_step(distance: float, step: float) -> bool:
    if isinstance(distance, int) and isinstance(step, int):
        return distance % step == 0
    return math.isclose(distance / step, round(distance / step), rel_tol=0, abs_tol=_TOLERANCE)


def _bounds(rule: Range) -> str:
    low = None if rule.low is None else f"{'more than' if rule.open_low else 'at least'} {shown(rule.low)}"
    high = None if rule.high is None else f"{'less than' if rule.open_high else 'at most'} {shown(rule.high)}"
    if low and high and not rule.open_low and not rule.open_high:
        return f"from {shown(rule.low)} to {shown(rule.high)}"
    return " and ".join(part for part in (low, high) if part)


def _none_of(rule: OneOf, value: ParameterValue) -> Objection | None:
    if any(value == one and isinstance(value, bool) == isinstance(one, bool) for one in rule.values):
        return None
    texts = [one for one in rule.values if isinstance(one, str)]
    near = nearest_text(value, texts)
    if not rule.values:
        return Objection("can have no value at all")
    if len(rule.values) == 1:
        return Objection(f"must be {shown(rule.values[0])}, not {shown(value)}", near)
    return Objection(f"must be one of {listed(rule.values)}, not {shown(value)}", near)


def _wrong_size(rule: Size, value: ParameterValue) -> Iterator[Objection]:
    if not isinstance(value, tuple | str):
        return
    size = (
        len(value.encode("utf-8", "surrogatepass")) if rule.octets and isinstance(value, str) else len(value)
    )
    if (rule.low is None or size >= rule.low) and (rule.high is None or size <= rule.high):
        return
    one, many = ("character", "characters") if isinstance(value, str) else ("item", "items")
    if rule.high is None and rule.low == 1:
        yield Objection("must not be empty")
    elif rule.low == rule.high:
        yield Objection(f"must have {rule.low} {one if rule.low == 1 else many}, not {size}")
    else:
        most = rule.high if rule.low is None or size >= rule.low else None
        wanted = f"at most {most}" if most is not None else f"at least {rule.low}"
        yield Objection(f"must have {wanted} {one if wanted.endswith(' 1') else many}, not {size}")


def _repeated(value: ParameterValue) -> Iterator[Objection]:
    if not isinstance(value, tuple):
        return
    seen: set[object] = set()
    for index, item in enumerate(value):
        if item in seen:
            yield Objection(f"must not have an item twice, as {shown(item)}", item=index)
            return
        seen.add(item)

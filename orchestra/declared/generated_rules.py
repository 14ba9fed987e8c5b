"""The validations of generate_parameter_library, as rules: a row for each function.

Source: its documentation (scalar, string and array validators); what is deprecated is there too. A string is measured
in octets, as `std::string::size` does.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.declared.kinds import FIXED
from orchestra.declared.rules import OneOf, Range, Rule, Size, Unique

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.declared.model import RosType


def rule_of(function: str, arguments: list[Any], kind: RosType) -> Rule | None:
    """Return the rule of a function; None where it says nothing of this type. Raises `ValueError` for its arguments."""
    count, make = RULES[function]
    if len(arguments) != count:
        words = {0: "takes no arguments", 1: "takes one argument", 2: "takes two arguments"}
        raise ValueError(f"{words[count]}, not {len(arguments)}")
    return make(arguments, kind)


def element_of(kind: str) -> str:
    """Return the type of a value, or of the items of a list, as a word."""
    return FIXED.sub("", kind).replace("_array", " list").replace("_", " ")


def _number(value: Any) -> float:  # noqa: ANN401 - as YAML has it
    if isinstance(value, bool | str) or not isinstance(value, int | float):
        raise ValueError(f"takes numbers, not {value!r}")  # noqa: TRY004 - of the file, not of the program
    return value


def _length(value: Any) -> int:  # noqa: ANN401 - as above
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise ValueError(f"takes a length, not {value!r}")
    return value


def _range(*, items: bool, open_: bool = False, low: int | None = None, high: int | None = None) -> Any:  # noqa: ANN401 - a maker
    """Return what makes a range; `low` and `high` are indices of arguments."""

    def make(arguments: list[Any], kind: RosType) -> Rule | None:
        numbers = [_number(item) for item in arguments]
        return Range(
            None if low is None else _of(numbers[low], kind),
            None if high is None else _of(numbers[high], kind),
            open_low=open_,
            open_high=open_,
            items=items,
        )

    return make


def _of(number: float, kind: RosType) -> float:
    """Return a bound as the type has it, for messages."""
    return float(number) if kind.startswith("double") else number


def _values(*, items: bool) -> Any:  # noqa: ANN401 - a maker
    def make(arguments: list[Any], kind: RosType) -> Rule | None:
        if not isinstance(arguments[0], list):
            raise ValueError("takes one list of values: [[a, b]]")  # noqa: TRY004 - of the file, not of the program
        doubles = kind.startswith("double")
        values = [float(item) if doubles and isinstance(item, int) else item for item in arguments[0]]
        return OneOf(tuple(values), items)

    return make


def _size(low: int | None = None, high: int | None = None) -> Any:  # noqa: ANN401 - a maker
    """Return what makes a size; `low` and `high` are added to the argument."""

    def make(arguments: list[Any], _kind: RosType) -> Rule | None:
        length = _length(arguments[0])
        least, most = (None if more is None else length + more for more in (low, high))
        return Size(least, most, octets=True)

    return make


def _not_empty(_arguments: list[Any], _kind: RosType) -> Rule:
    return Size(low=1, octets=True)


def _unique(_arguments: list[Any], _kind: RosType) -> Rule:
    return Unique()


# By name, without `<>`: the number of arguments, and what makes the rule.
RULES: Final[dict[str, tuple[int, Callable[[list[Any], RosType], Rule | None]]]] = {
    "bounds": (2, _range(items=False, low=0, high=1)),
    "lower_bounds": (1, _range(items=False, low=0)),
    "upper_bounds": (1, _range(items=False, high=0)),
    "gt": (1, _range(items=False, low=0, open_=True)),
    "gt_eq": (1, _range(items=False, low=0)),
    "lt": (1, _range(items=False, high=0, open_=True)),
    "lt_eq": (1, _range(items=False, high=0)),
    "one_of": (1, _values(items=False)),
    "not_empty": (0, _not_empty),
    "fixed_size": (1, _size(low=0, high=0)),
    "size_gt": (1, _size(low=1)),
    "size_lt": (1, _size(high=-1)),
    "unique": (0, _unique),
    "subset_of": (1, _values(items=True)),
    "element_bounds": (2, _range(items=True, low=0, high=1)),
    "lower_element_bounds": (1, _range(items=True, low=0)),
    "upper_element_bounds": (1, _range(items=True, high=0)),
}

"""Takes single values out of a node's parameters, with their types checked and their defaults noted."""

import math
import re
from collections.abc import Mapping, Sequence
from typing import Protocol, TypeVar

import numpy as np

_Value = TypeVar("_Value")

# 1e-9 and 1.0e9 are numbers to ROS and in YAML 1.2; readers of YAML 1.1, such as PyYAML, give them as text.
_EXPONENT = re.compile(r"[-+]?\d+(\.\d*)?[eE][-+]?\d+")


class ParameterError(Exception):
    """A parameter makes it impossible to start; the text names it and says what is allowed."""


class Report(Protocol):
    """Where faults in parameters are told; an rclpy logger is one."""

    def warning(self, message: str) -> object:
        """Tell what is questionable and how it is understood: robot_localization goes on with it, and so do we."""

    def error(self, message: str) -> object:
        """Tell what is wrong and not used: robot_localization would not start."""


class Reader:
    """Reads parameters by name and remembers each name with the value that is in force.

    A value of the wrong type is told to the report and replaced by the default. Whole numbers count as doubles, text
    such as 1e-9 too, and any sequence of numbers as a list of doubles. A parameter without a value is not set.
    """

    def __init__(self, values: Mapping[str, object], report: Report) -> None:
        self._values = {name: value for name, value in values.items() if value is not None}
        self.report = report
        self.in_force: dict[str, object] = {}

    def has(self, name: str) -> bool:
        """Whether the parameter is set."""
        return name in self._values

    def unread(self) -> list[str]:
        """Names that are set and that nobody has asked for."""
        return sorted(name for name in self._values if name not in self.in_force)

    def know(self, *names: str) -> None:
        """Take note of parameters that have no effect as things are; those that are set stay what they are."""
        self.in_force.update((name, self._values[name]) for name in names if name in self._values)

    def boolean(self, name: str, *, default: bool = False) -> bool:
        """Read a true or false."""
        value = self._values.get(name, default)
        if not isinstance(value, bool):
            value = self._refused(name, value, "true or false", default)
        self.in_force[name] = value
        return value

    def number(self, name: str, default: float) -> float:
        """Read a finite number as a double."""
        value = self._values.get(name, default)
        number = _double(value)
        if number is None:
            number = self._refused(name, value, "a number", default)
        elif not math.isfinite(number):
            self.report.warning(
                f"parameter {name} must be a finite number, not {value!r}; {default!r} is used instead"
            )
            number = default
        self.in_force[name] = number
        return number

    def positive(self, name: str, default: float) -> float:
        """Read a number greater than zero."""
        number = self.number(name, default)
        if number <= 0.0:
            number = self._refused(name, number, "greater than zero", default)
            self.in_force[name] = number
        return number

    def threshold(self, name: str, default: float) -> float:
        """Read a distance; whatever cannot be reached, such as infinity, is the default, and so is no number."""
        value = self._values.get(name, default)
        number = _double(value)
        if number is None:
            number = self._refused(name, value, "a number", default)
        elif not math.isfinite(number):
            number = default
        self.in_force[name] = number
        return abs(number)

    def count(self, name: str, default: int) -> int:
        """Read a whole number from 1 on."""
        value = self._values.get(name, default)
        if isinstance(value, bool) or not isinstance(value, int):
            value = self._refused(name, value, "a whole number from 1 on", default)
        elif value < 1:
            self.report.warning(
                f"parameter {name} must be a whole number from 1 on, not {value}; {default} is used instead"
            )
            value = default
        self.in_force[name] = value
        return value

    def text(self, name: str, default: str) -> str:
        """Read a string."""
        value = self._values.get(name, default)
        if not isinstance(value, str):
            value = self._refused(name, value, "a string", default)
        self.in_force[name] = value
        return value

    def numbers(self, name: str) -> tuple[float, ...] | None:
        """Read a list of finite numbers; None if it is not set or not such a list."""
        value = self._values.get(name)
        if value is None:
            return None
        doubles = _doubles(value)
        if doubles is None:
            self.report.error(f"parameter {name} must be a list of numbers, not {value!r}; it is not used")
            self.in_force[name] = []
            return None
        if not all(map(math.isfinite, doubles)):
            self.report.warning(f"parameter {name} must be a list of finite numbers; it is not used")
            self.in_force[name] = []
            return None
        self.in_force[name] = list(doubles)
        return doubles

    def flags(self, name: str) -> tuple[bool, ...] | None:
        """Read a list of booleans; None if it is not set, or told as an error and not such a list."""
        value = self._values.get(name)
        if value is None:
            return None
        items = list(value) if isinstance(value, Sequence) and not isinstance(value, str) else [value]
        if not all(isinstance(item, bool) for item in items):
            self.report.error(f"parameter {name} must be a list of booleans, not {value!r}; it is not used")
            self.in_force[name] = []
            return None
        self.in_force[name] = items
        return tuple(bool(item) for item in items)

    def _refused(self, name: str, value: object, wanted: str, default: _Value) -> _Value:
        self.report.error(f"parameter {name} must be {wanted}, not {value!r}; {default!r} is used instead")
        return default


def _double(value: object) -> float | None:
    if isinstance(value, str) and _EXPONENT.fullmatch(value):
        return float(value)
    if isinstance(value, bool) or not isinstance(value, int | float | np.number):
        return None
    return float(value)


def _doubles(value: object) -> tuple[float, ...] | None:
    if isinstance(value, str) or not isinstance(value, Sequence):
        return None
    doubles = [number for number in map(_double, value) if number is not None]
    return tuple(doubles) if len(doubles) == len(value) else None

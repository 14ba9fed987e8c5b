"""Values that ROS 2 refuses, or takes for something else, where it is plain what they are meant for.

They are made use of as they are meant, with a warning: the file does not run there.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import told
from orchestra.compat.forms_meant import MEANT_FALSE, MEANT_TRUE
from orchestra.compat.remarks import remark_of_value

if TYPE_CHECKING:
    from orchestra.compat.place import Place

_REFUSED: Final = "ROS 2 refuses it"
_OF_PROCESSES: Final = (
    *("respawn", "shell", "cached_output", "log_cmd", "emulate_tty"),
    *("respawn_delay", "respawn_max_retries"),
)
_NUMBER: Final = re.compile(r"\s*[-+]?\d+(\.\d*)?\s*")


def tell_text_of_truth(name: str, value: Any, place: Place) -> None:
    """Warn of a text where a truth value or a substitution is taken."""
    if isinstance(value, str) and value.strip().lower() in MEANT_FALSE | MEANT_TRUE:
        _tell(f"{name} is True or False, this is {value!r}: {_REFUSED}", value, place, name)


def tell_counted_as_true(given: dict[str, Any], place: Place) -> None:
    """Warn of what only counts as true, where nothing but a truth value is looked at."""
    for name, value in given.items():
        is_false = isinstance(value, str) and value.strip().lower() in MEANT_FALSE
        if is_false or callable(getattr(value, "perform", None)):
            _tell(
                f"{name} is True or False, this is {told(value)}: ROS 2 takes it for true", value, place, name
            )


def tell_no_float(period: Any, place: Place) -> None:
    """Warn of the period of a timer that is a whole number."""
    if type(period) is int:
        _tell(f"the period of a timer is a float, this is {period!r}: {_REFUSED}", period, place, "period")


def tell_of_process(given: tuple[Any, ...], timeouts: dict[str, Any], place: Place) -> None:
    """Warn of what the constructor of a process is given: `given` is in the order of `_OF_PROCESSES`."""
    named = dict(zip(_OF_PROCESSES, given, strict=True))
    tell_text_of_truth("respawn", named.pop("respawn"), place)
    tell_no_number({name: named.pop(name) for name in ("respawn_delay", "respawn_max_retries")}, place)
    tell_counted_as_true(named, place)
    tell_no_text(timeouts, place)


def tell_no_number(given: dict[str, Any], place: Place) -> None:
    """Warn of what is compared with numbers when a process ends, and is none."""
    for name, value in given.items():
        if (isinstance(value, str) and _NUMBER.fullmatch(value)) or callable(getattr(value, "perform", None)):
            fails = "ROS 2 fails when the process ends"
            _tell(f"{name} is a number, this is {told(value)}: {fails}", value, place, name)


def tell_no_text(given: dict[str, Any], place: Place) -> None:
    """Warn of numbers where a text is taken."""
    for name, value in given.items():
        if isinstance(value, int | float):
            _tell(f"{name} is a text, this is {value!r}: {_REFUSED}", value, place, name)


def tell_no_pairs(arguments: Any, place: Place) -> None:
    """Warn of launch arguments that are a dictionary: going through it gives names alone."""
    if arguments:
        message = f"launch_arguments are pairs, this is a dict: {_REFUSED}, and takes its .items()"
        _tell(message, arguments, place, "launch_arguments")


def tell_no_mapping(configurations: Any, place: Place) -> None:
    """Warn of the configurations of a group that are pairs."""
    name = "launch_configurations"
    _tell(f"{name} are a dict, this is {told(configurations)}: {_REFUSED}", configurations, place, name)


def tell_no_function(name: str, value: Any, place: Place) -> None:
    """Warn of actions where ROS 2 calls what it was given."""
    told_so = f"{name} is a function of the event, this is {told(value)}: ROS 2 fails to call it"
    _tell(told_so, value, place, name)


def tell_no_predicate(name: str, value: Any, place: Place) -> None:
    """Warn of an action where ROS 2 calls a predicate on actions."""
    told_so = f"{name} is a predicate on actions, this is {told(value)}: ROS 2 fails to call it"
    _tell(told_so, value, place, name)


def _tell(message: str, value: Any, place: Place, name: str) -> None:
    remark_of_value(message, value, place, name)

"""Whether the settings of the middleware and of logging can work, before anything starts.

What rcl, rcutils and Fast DDS of ROS 2 Jazzy do with each value was tried: what they refuse, or what ends the process,
is an error; what they pass over, mostly without a word, a warning.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.errors import Code
from orchestra.nearest import nearest
from orchestra.plan.checks.middleware_files import check_files
from orchestra.plan.checks.middleware_installed import check_implementation, is_written
from orchestra.plan.checks.security import check_security

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.resolve.inputs import Inputs
    from orchestra.resolve.model import Resolved

_RANGES: Final = ("SUBNET", "LOCALHOST", "OFF", "SYSTEM_DEFAULT")
_MODES: Final = ("SYNCHRONOUS", "ASYNCHRONOUS", "AUTO")
_TOKENS: Final = (
    *("severity", "name", "message", "function_name", "file_name", "line_number"),
    *("time", "time_as_nanoseconds", "date_time_with_ms", "short_severity"),
)
_TOKEN: Final = re.compile(r"\{(\w+)\}")
_HIGHEST_DOMAIN: Final = 232  # whose ports are below 65536 (DDSI-RTPS 2.2, section 9.6.1)
_HIGHEST_PORT: Final = 65535


class Setting(NamedTuple):
    """The value of a variable for a process, and where it is set: None in the environment of the caller."""

    name: str
    value: str
    location: Location | None


class _Told(NamedTuple):
    message: str
    is_error: bool = False
    meant: str | None = None


def check_middleware(resolved: Resolved, inputs: Inputs, problems: Problems) -> None:
    """Report settings that cannot work, of the description and, where it starts nodes, of the caller."""
    if all(process.faulty for process in resolved.processes):
        return
    for setting in _settings(resolved, inputs.environment):
        check = _CHECKS.get(setting.name)
        if check is not None and setting.value and (told := check(setting.value)) is not None:
            report = problems.error if told.is_error else problems.warning
            meant = told.meant if told.meant and is_written(setting.value, setting.location) else None
            hint = f"; did you mean '{told.meant}'?" if told.meant and not meant else ""
            message = f"{setting.name}: {told.message}{hint}"
            report(Code.MIDDLEWARE_SETTING, message, setting.location, suggestion=meant)
        check_implementation(setting.name, setting.value, setting.location, inputs, problems)
        check_files(setting.name, setting.value, setting.location, inputs, problems)
    check_security(resolved.processes, inputs.environment, problems)


def _settings(resolved: Resolved, environment: Mapping[str, str]) -> Iterator[Setting]:
    nodes = [
        process for process in resolved.processes if process.kind != "process" and process.inherit_environment
    ]
    set_by_all = set.intersection(*(set(process.environment) for process in nodes)) if nodes else set()
    names = (*_CHECKS, "RMW_IMPLEMENTATION", *_FILES)
    for name in names if nodes else ():
        if environment.get(name) and name not in set_by_all:
            yield Setting(name, environment[name], None)
    for process in resolved.processes:
        for name, changes in process.environment.items():
            if changes[-1].value and not process.faulty:
                yield Setting(name, changes[-1].value, changes[-1].location)


_FILES: Final = ("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE", "CYCLONEDDS_URI")


def _domain(value: str) -> _Told | None:
    if value.isdecimal() and (value == "0" or not value.startswith("0")):
        if int(value) > _HIGHEST_DOMAIN:
            return _Told(f"a domain is between 0 and {_HIGHEST_DOMAIN}, not {value}", is_error=True)
        return None
    # As strtoul(3) reads it: space, a sign, a base by its prefix, digits, and whatever comes behind.
    found = re.match(r"\s*([+-]?)(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9][0-9]*)", value)
    if found is None:
        return _Told(f"'{value}' is not a number", is_error=True)
    digits = found[2]
    number = int(digits, 16) if digits[:2].lower() == "0x" else int(digits, 8 if digits[0] == "0" else 10)
    if found[1] == "-" or number > _HIGHEST_DOMAIN:
        return _Told(f"a domain is between 0 and {_HIGHEST_DOMAIN}, not '{value}'", is_error=True)
    return _Told(f"'{value}' is read as {number}")


def _one_of(words: tuple[str, ...], otherwise: str) -> Callable[[str], _Told | None]:
    def check(value: str) -> _Told | None:
        if value in words:
            return None
        near = value.upper() if value.upper() in words else nearest(value, words)
        rest = "" if near else f": it is one of {', '.join(words)}"
        return _Told(f"'{value}' {otherwise}{rest}", meant=near)

    return check


def _switch(value: str) -> _Told | None:
    return (
        None
        if value in ("0", "1")
        else _Told(f"it is 0 or 1: with '{value}' rcutils complains in place of logging")
    )


def _format(value: str) -> _Told | None:
    unknown = [word for word in _TOKEN.findall(value) if word not in _TOKENS]
    if not unknown:
        return None
    near = nearest(unknown[0], _TOKENS)
    meant = value.replace(f"{{{unknown[0]}}}", f"{{{near}}}") if near else None
    return _Told(f"'{{{unknown[0]}}}' stands for nothing", meant=meant)


def _servers(value: str) -> _Told | None:
    for entry in filter(None, value.split(";")):
        address, _, port = entry.rpartition(":") if ":" in entry else (entry, "", "")
        if address.startswith("[") and port.endswith("]"):
            continue  # an address of IPv6 without a port
        if port and not (port.isdecimal() and 0 < int(port) <= _HIGHEST_PORT):
            return _Told(f"'{entry}': a port is between 1 and {_HIGHEST_PORT}", is_error=True)
        if "," in entry or " " in entry.strip():
            return _Told(f"'{entry}': servers stand between semicolons", is_error=True)
    return None


def _peers(value: str) -> _Told | None:
    odd = next((entry for entry in value.split(";") if "," in entry or " " in entry.strip()), None)
    return None if odd is None else _Told(f"'{odd}': peers stand between semicolons", is_error=True)


_CHECKS: Final[dict[str, Callable[[str], _Told | None]]] = {
    "ROS_DOMAIN_ID": _domain,
    "ROS_AUTOMATIC_DISCOVERY_RANGE": _one_of(
        _RANGES, "is passed over, and discovery reaches this machine only"
    ),
    "ROS_STATIC_PEERS": _peers,
    "ROS_DISCOVERY_SERVER": _servers,
    "RMW_FASTRTPS_PUBLICATION_MODE": _one_of(_MODES, "is passed over"),
    "RCUTILS_LOGGING_USE_STDOUT": _switch,
    "RCUTILS_LOGGING_BUFFERED_STREAM": _switch,
    "RCUTILS_COLORIZED_OUTPUT": _switch,
    "RCUTILS_CONSOLE_OUTPUT_FORMAT": _format,
}

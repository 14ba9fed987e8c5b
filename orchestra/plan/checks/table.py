"""The table of checks. Each looks at what was resolved and planned as a whole, and reports."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, Protocol

from orchestra.plan.checks.cores import check_cores
from orchestra.plan.checks.declared import check_declared
from orchestra.plan.checks.doubled import check_doubled
from orchestra.plan.checks.interfaces import check_interfaces
from orchestra.plan.checks.nameless import check_nameless
from orchestra.plan.checks.sections import check_sections
from orchestra.plan.checks.topics import check_topics
from orchestra.plan.checks.waits import check_waits
from orchestra.witness.once import once
from orchestra.witness.variables import ObservedEnvironment

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.errors import Problems
    from orchestra.plan.model import Plan
    from orchestra.resolve.model import Resolved


class Check(Protocol):
    """Finds one kind of mistake. What is `faulty`, `lost` or follows from a reported problem is left alone."""

    def __call__(self, resolved: Resolved, plan: Plan, problems: Problems, /) -> None:
        """Report what is wrong."""


def _check_unlike(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """See `check_unlike`, which only several nodes need."""
    if len(resolved.processes) + len(resolved.components) > 1:
        from orchestra.plan.checks.unlike import check_unlike  # noqa: PLC0415

        check_unlike(resolved, plan, problems)


CHECKS: Final[tuple[Check, ...]] = (
    check_declared,
    _check_unlike,
    check_interfaces,
    check_sections,
    check_waits,
    check_doubled,
    check_topics,
    check_cores,
    check_nameless,
)


def check_all(resolved: Resolved, plan: Plan, problems: Problems) -> None:
    """Let every check look at a plan."""
    for check in CHECKS:
        check(resolved, plan, problems)


# Of the caller's variables those that decide with whom nodes talk and how they log (`middleware`).
PREFIXES: Final = ("ROS_", "RMW_", "RCUTILS_", "FASTDDS_", "FASTRTPS_", "CYCLONEDDS_")
CHECKED: Final = (
    *("ROS_DOMAIN_ID", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS", "ROS_DISCOVERY_SERVER"),
    *("RMW_IMPLEMENTATION", "RMW_FASTRTPS_PUBLICATION_MODE", "RCUTILS_CONSOLE_OUTPUT_FORMAT"),
    *("RCUTILS_LOGGING_USE_STDOUT", "RCUTILS_LOGGING_BUFFERED_STREAM", "RCUTILS_COLORIZED_OUTPUT"),
    *("FASTDDS_DEFAULT_PROFILES_FILE", "FASTRTPS_DEFAULT_PROFILES_FILE", "CYCLONEDDS_URI"),
    *(
        "ROS_SECURITY_ENABLE",
        "ROS_SECURITY_STRATEGY",
        "ROS_SECURITY_KEYSTORE",
        "ROS_SECURITY_ENCLAVE_OVERRIDE",
    ),
)

_COMMON: Final = {
    "ROS_AUTOMATIC_DISCOVERY_RANGE": ("SUBNET", "LOCALHOST"),
    "RMW_IMPLEMENTATION": ("rmw_fastrtps_cpp",),
    "RCUTILS_COLORIZED_OUTPUT": ("0", "1"),
    "ROS_SECURITY_ENABLE": ("false",),
}


def has_settings(resolved: Resolved, environment: Mapping[str, str]) -> bool:
    """Tell whether any process that may be a node has such a variable, or says on its command line how it logs."""
    if _is_set(environment):
        return bool(resolved.processes)
    names = {name for process in resolved.processes if process.environment for name in process.environment}
    return any(name.startswith(PREFIXES) for name in names) or any(
        "--log-level" in words or "--enclave" in words for words in _words(resolved)
    )


def _is_set(environment: Mapping[str, str]) -> bool:
    """Tell whether there is such a variable among the caller's; of one environment that is found out once."""

    def find() -> bool:
        return any((value := environment.get(name)) and not _is_common(name, value) for name in CHECKED)

    return once(("settings of nodes",), find) if isinstance(environment, ObservedEnvironment) else find()


def _is_common(name: str, value: str) -> bool:
    """Tell whether a value of the caller's is one that many have, and certainly right."""
    if name == "ROS_DOMAIN_ID":
        return value.isdecimal() and (value == "0" or (value[0] != "0" and len(value) <= 2))  # noqa: PLR2004 - digits
    return value in _COMMON.get(name, ())


def _words(resolved: Resolved) -> list[tuple[str, ...]]:
    return [
        (*process.arguments, *(process.ros_arguments or ()))
        for process in resolved.processes
        if (process.arguments or process.ros_arguments) and process.kind != "process"
    ]

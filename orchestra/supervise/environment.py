"""The environment of a node: the caller's, what the wheels and the run need, what the description says, the marks.

Later entries win, so a description can overrule everything but the marks. What a service manager says to us is for us
alone (`summons`).

PATH gets the interpreter's folder in front only where that is a virtual environment that is not on it: a script with
`#!/usr/bin/env python3` then finds the interpreter that has rclpy, as if the environment had been activated, and
whoever chose an order keeps it. RCUTILS_LOGGING_BUFFERED_STREAM stays as it is: unset, rcutils hands over each message
in one write; set to 1 it takes three (rcutils of Jazzy, counted on a packet socket).

A process that is to inherit nothing (`env` of the launch language, which replaces the whole environment) gets what its
description says, the marks, and of the rest only what a ROS process cannot start without, unless the description gives
it: where the wheels' shared libraries and the ament index are, and a folder for logs, since without it and without HOME
rcl refuses to start. All else, PATH, ROS_DOMAIN_ID and the reach of discovery included, is as the description says.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from orchestra.dataclass import dataclass
from orchestra.supervise.keeping.marks import PROCESS, RUN
from orchestra.supervise.summons import PERSONAL
from orchestra.wheels import DONE, LIBRARY_PATH

if TYPE_CHECKING:
    from collections.abc import Callable, ItemsView, Iterator

# Whoever sets one of these has said where discovery is to reach.
_DISCOVERY = ("ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOCALHOST_ONLY", "ROS_DISCOVERY_SERVER")
# The variables that decide with whom a participant talks, and how.
_MIDDLEWARE_PREFIXES = ("ROS_", "RMW_", "FASTDDS_", "FASTRTPS_", "CYCLONEDDS_", "ZENOH_", "SKIP_DEFAULT_XML")


@dataclass(frozen=True, slots=True)
class Host:
    """What the interpreter offers to nodes.

    `prefix` is its installation, `path` the folder of its executables where it is a virtual environment, `libraries`
    the folders of the wheels' shared libraries (none where the wheels do not bootstrap), `ament` whether it has an
    ament index. One of `libraries` may stand for several that are `gathered` there.
    """

    prefix: str
    path: str | None
    libraries: tuple[str, ...]
    ament: bool
    gathered: frozenset[str] = frozenset()


def node_environment(
    caller: Mapping[str, str],
    host: Host,
    description: Mapping[str, str | None],
    *,
    log_folder: str,
    colour: bool,
    marks: tuple[str, str],
    inherit: bool = True,
) -> dict[str, str]:
    """Return the environment of a process; `marks` are the ids of the run and of the process."""
    common = common_environment(caller, host, log_folder=log_folder, colour=colour, inherit=inherit)
    return described(common, description, marks)


def common_environment(
    caller: Mapping[str, str], host: Host, *, log_folder: str, colour: bool, inherit: bool
) -> dict[str, str]:
    """Return what all processes of a run have, those that inherit or those that do not."""
    if not inherit:
        return {**_for_wheels({"PATH": host.path or ""}, host), "ROS_LOG_DIR": log_folder}
    caller = {name: value for name, value in caller.items() if name not in PERSONAL}
    return {**caller, **_for_run(caller, log_folder, colour=colour), **_for_wheels(caller, host)}


def described(
    common: dict[str, str], description: Mapping[str, str | None], marks: tuple[str, str]
) -> dict[str, str]:
    """Return the environment of one process: with what its description says, and its marks."""
    environment = common.copy()
    for name, value in description.items():
        if value is None:
            environment.pop(name, None)
        else:
            environment[name] = value
    if LIBRARY_PATH in description and DONE not in description:
        # The folders of the wheels are gone: each interpreter starts itself a second time and puts them there.
        environment.pop(DONE, None)
    environment[RUN], environment[PROCESS] = marks
    return environment


class Later(Mapping[str, str]):
    """An environment that is made when somebody looks at it: it has a few kilobytes, and few are looked at."""

    __slots__ = ("_make",)

    def __init__(self, make: Callable[[], Mapping[str, str]]) -> None:
        self._make = make

    def __getitem__(self, name: str) -> str:
        return self._make()[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._make())

    def __len__(self) -> int:
        return len(self._make())

    def items(self) -> ItemsView[str, str]:
        """Make it once for all of them."""
        return self._make().items()


def middleware(environment: Mapping[str, str]) -> dict[str, str]:
    """Return the part of an environment that decides with whom a participant can talk."""
    return {name: value for name, value in environment.items() if name.startswith(_MIDDLEWARE_PREFIXES)}


def _for_run(caller: Mapping[str, str], log_folder: str, *, colour: bool) -> dict[str, str]:
    wanted = {"PYTHONUNBUFFERED": "1", "PYTHONFAULTHANDLER": "1"}
    if not any(caller.get(name) for name in _DISCOVERY):
        wanted["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    if not caller.get("ROS_HOME"):
        wanted["ROS_LOG_DIR"] = log_folder
    if colour:
        wanted["RCUTILS_COLORIZED_OUTPUT"] = "1"
    return {name: value for name, value in wanted.items() if not caller.get(name)}


def _for_wheels(caller: Mapping[str, str], host: Host) -> dict[str, str]:
    """Do what `ros_wheels_bootstrapper` does, so that it need not start each interpreter a second time."""
    found: dict[str, str] = {}
    if host.libraries:
        found[LIBRARY_PATH] = _joined(host.libraries, caller.get(LIBRARY_PATH), host.gathered)
        found[DONE] = "1"
    if host.ament:
        # Last: packages that the user has sourced come before those of the wheels.
        prefixes = [entry for entry in caller.get("AMENT_PREFIX_PATH", "").split(":") if entry]
        found["AMENT_PREFIX_PATH"] = ":".join(dict.fromkeys([*prefixes, host.prefix]))
    if host.path and host.path not in caller.get("PATH", "").split(":"):
        found["PATH"] = _joined((host.path,), caller.get("PATH"))
    return found


def _joined(first: tuple[str, ...], rest: str | None, without: frozenset[str] = frozenset()) -> str:
    entries = [entry for entry in (rest or "").split(":") if entry and entry not in without]
    return ":".join(dict.fromkeys([*first, *entries]))

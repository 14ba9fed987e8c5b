"""Whether processes that ask for security (SROS 2) get it: rcl goes on without where something is missing.

Unless the strategy is `Enforce`, a missing keystore or enclave leaves a node unprotected, without a word; a Fast DDS
that is built without security, as that of the wheels, protects nothing and refuses `Enforce` with a message about
compiling it.
"""

from __future__ import annotations

import mmap
import os
import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.resolve.packages import ament

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from orchestra.errors import Problems
    from orchestra.location import Location
    from orchestra.resolve.model import ResolvedProcess

_ENABLE, _STRATEGY = "ROS_SECURITY_ENABLE", "ROS_SECURITY_STRATEGY"
_KEYSTORE, _OVERRIDE = "ROS_SECURITY_KEYSTORE", "ROS_SECURITY_ENCLAVE_OVERRIDE"
_STRATEGIES: Final = ("Enforce", "Permissive")
# What rcl wants to find in the folder of an enclave (rcl, `security.c`).
_FILES: Final = (
    *("identity_ca.cert.pem", "cert.pem", "key.pem"),
    *("permissions_ca.cert.pem", "governance.p7s", "permissions.p7s"),
)
_VARIABLES: Final = (_ENABLE, _STRATEGY, _KEYSTORE, _OVERRIDE)
_ENCLAVE: Final = frozenset({"-e", "--enclave"})
_SYMBOL: Final = b"SecurityManager"  # a class that Fast DDS has only where it is built with security


def check_security(
    processes: Sequence[ResolvedProcess], environment: Mapping[str, str], problems: Problems
) -> None:
    """Report why processes that ask for security would run without, or not at all; most say nothing of it."""
    inherited = any(name in environment for name in _VARIABLES)
    for process in processes:
        if (
            inherited
            or not process.environment.keys().isdisjoint(_VARIABLES)
            or not _ENCLAVE.isdisjoint(process.arguments)
            or not _ENCLAVE.isdisjoint(process.ros_arguments or ())
        ):
            _check(process, environment, problems)


def _check(process: ResolvedProcess, environment: Mapping[str, str], problems: Problems) -> None:
    """Report why a process that asks for security would run without, or not at all."""
    if process.kind == "process" or process.faulty:
        return
    where, location = _variables(process, environment)
    enclave = where.get(_OVERRIDE) or _enclave_of(process)
    if not enclave.startswith("/"):  # rcl does not start then, with or without security
        problems.error(
            Code.NO_SECURITY, f"the name of an enclave begins with '/': '{enclave}'", process.location
        )
        return
    enabled = where.get(_ENABLE, "")
    if enabled not in ("", "true", "false"):
        told = f"{_ENABLE}: '{enabled}' turns security off: only 'true' turns it on"
        problems.warning(Code.NO_SECURITY, told, location.get(_ENABLE))
    if enabled != "true":
        return
    if _is_without(environment):
        told = "security is asked for, but the Fast DDS that is installed is built without: nothing would be protected"
        problems.error(Code.NO_SECURITY, told, location.get(_ENABLE))
        return
    strategy = where.get(_STRATEGY, "")
    if strategy not in ("", *_STRATEGIES):
        told = (
            f"{_STRATEGY}: '{strategy}' means Permissive; only 'Enforce' keeps nodes from running unprotected"
        )
        problems.warning(Code.NO_SECURITY, told, location.get(_STRATEGY))
    _check_enclave(process, enclave, where, location, problems)


def _check_enclave(
    process: ResolvedProcess,
    enclave: str,
    where: Mapping[str, str],
    location: Mapping[str, Location],
    problems: Problems,
) -> None:
    keystore = where.get(_KEYSTORE, "")
    if not keystore or not Path(keystore).is_dir():
        told = f"there is no keystore {keystore}" if keystore else f"{_KEYSTORE} is not set"
        problems.error(
            Code.NO_SECURITY, f"security is asked for, but {told}", location.get(_KEYSTORE, process.location)
        )
        return
    folder = Path(keystore, "enclaves", enclave.lstrip("/"))
    missing = [name for name in _FILES if not (folder / name).is_file()]
    if missing:
        told = f"the enclave {enclave} has no {missing[0]} in {folder}"
        problems.error(Code.NO_SECURITY, told, process.location)


def _variables(
    process: ResolvedProcess, environment: Mapping[str, str]
) -> tuple[dict[str, str], dict[str, Location]]:
    """Return the variables about security of a process, and where those of the description are set."""
    inherited = environment if process.inherit_environment else {}
    found = {name: inherited[name] for name in _VARIABLES if name in inherited}
    location: dict[str, Location] = {}
    for name in _VARIABLES:
        if changes := process.environment.get(name):
            found[name] = changes[-1].value or ""
            location[name] = changes[-1].location
    return found, location


def _enclave_of(process: ResolvedProcess) -> str:
    words = [*process.arguments, *(process.ros_arguments or ())]
    return next((words[place + 1] for place, word in enumerate(words[:-1]) if word in _ENCLAVE), "/")


def _is_without(environment: Mapping[str, str]) -> bool:
    """Tell whether every Fast DDS that can be found is built without security."""
    listed = [Path(entry) for entry in environment.get("LD_LIBRARY_PATH", "").split(os.pathsep) if entry]
    folders = [*listed, *(prefix / "lib" for prefix in ament.prefixes(environment)), Path(sys.prefix, "lib")]
    libraries = {
        path.resolve() for folder in folders for path in folder.glob("libfast*s.so*") if path.is_file()
    }
    return bool(libraries) and not any(map(_has_security, libraries))


@cache
def _has_security(library: Path) -> bool:
    with library.open("rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        return content.find(_SYMBOL) >= 0

"""Whether the system would start a file: its interpreter is there, its line ends are right, its machine is ours.

Source: execve(2); `Elf64_Ehdr` in elf(5).
"""

from __future__ import annotations

import os
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.nearest import nearest
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Mapping

_BEGINNING: Final = 256  # bytes; Linux looks no further for the line of an interpreter
_ELF: Final = b"\x7fELF"
# Machines by their number in ELF; those that nobody runs ROS on are left out.
_MACHINES: Final = {3: "i386", 40: "arm", 62: "x86_64", 183: "aarch64", 243: "riscv64"}
_RUNS_TOO: Final = {
    "x86_64": {"i386"},
    "aarch64": {"arm"},
    "armv7l": {"arm"},
    "armv8l": {"arm"},
    "i686": {"i386"},
}
_FOREIGN: Final = Path("/proc/sys/fs/binfmt_misc/status")  # where it is, others may be run by an emulator


@dataclass(frozen=True, slots=True)
class Fault:
    """Why a file cannot be started; `here`: it may well be on another machine."""

    reason: str
    notes: tuple[str, ...] = ()
    here: bool = False


def fault_of(path: str, environment: Mapping[str, str]) -> Fault | None:
    """Return why an executable file cannot be started, None where nothing speaks against it."""
    try:
        with open(path, "rb", buffering=0) as stream:  # noqa: PTH123 - pathlib is slow
            beginning = stream.read(_BEGINNING)
    except OSError:
        return None  # executable and not readable: the system may start it all the same
    if beginning.startswith(b"#!"):
        return _of_script(beginning, environment)
    return _of_program(beginning) if beginning.startswith(_ELF) else None


def program_on_path(name: str, environment: Mapping[str, str]) -> str | None:
    """Return the path of a program of the search path, None where it has none of that name."""
    return _which(name, environment.get("PATH", os.defpath))


@lru_cache(maxsize=256)  # a description starts the same programs again and again
def _which(name: str, path: str) -> str | None:
    import shutil  # noqa: PLC0415 - slow, and of no use where programs are named by their paths

    return shutil.which(name, path=path)


def programs_on_path(environment: Mapping[str, str]) -> set[str]:
    """Return the names of everything on the search path."""
    path = environment.get("PATH", os.defpath)
    return once(("programs", path), lambda: _listed(path))


def _listed(path: str) -> set[str]:
    names: set[str] = set()
    for folder in path.split(os.pathsep):
        try:
            names.update(os.listdir(folder or "."))  # noqa: PTH208 - names are all that is needed
        except OSError:
            continue
    return names


def _of_script(beginning: bytes, environment: Mapping[str, str]) -> Fault | None:
    line, ended, _ = beginning.partition(b"\n")
    if not ended and len(beginning) == _BEGINNING:
        return None
    text = line[2:].decode("utf-8", "replace")
    if text.endswith("\r"):
        return Fault(
            "its first line ends with a carriage return, which becomes part of the interpreter's name",
            ("save it with the line ends of Unix (`sed -i 's/\\r$//' FILE`)",),
        )
    words = text.split()
    if not words:
        return Fault("its first line names no interpreter behind '#!'")
    if not os.path.exists(words[0]):  # noqa: PTH110 - a cheap look
        return Fault(f"its interpreter {words[0]} is not here", here=True)
    if words[0].rpartition("/")[2] != "env":
        return None
    called = next((word for word in words[1:] if not word.startswith("-") and "=" not in word), None)
    if called is None or "/" in called or program_on_path(called, environment) is not None:
        return None
    meant = nearest(called, programs_on_path(environment))
    return Fault(
        f"its interpreter {called} is not on the search path",
        (f"did you mean '{meant}'?",) if meant else (),
        here=True,
    )


def _of_program(beginning: bytes) -> Fault | None:
    if len(beginning) < 20 or _FOREIGN.exists():  # noqa: PLR2004 - up to e_machine
        return None
    little = beginning[5] != 2  # noqa: PLR2004 - ELFDATA2MSB
    machine = _MACHINES.get(int.from_bytes(beginning[18:20], "little" if little else "big"))
    ours = os.uname().machine
    if machine is None or machine == ours or machine in _RUNS_TOO.get(ours, ()):
        return None
    return Fault(f"it is built for {machine}, and this machine is {ours}", here=True)

"""Which processes the fork server can start, and why not the others.

What it forks has the interpreter, the flags and the imports that it has itself. So a process is started cold wherever
its result could differ: another interpreter, flags, variables that are read before a program begins, what a prefix or a
shell does first, a limit on memory that would count what is shared.
"""

from __future__ import annotations

import os
import sys
from functools import cache
from operator import attrgetter
from typing import TYPE_CHECKING, Literal, NamedTuple

from orchestra.fields import replace
from orchestra.plan.model import Warm
from orchestra.plan.startup import is_read_at_startup
from orchestra.resolve.runnable import program_on_path
from orchestra.witness.once import once

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.plan.model import Plan, Process
    from orchestra.resolve.model import ResolvedProcess

NOT_WANTED = "the description says so"
# What begins with the interpreter, or before it, and would watch the server instead of the node.
_FROM_THE_START = (
    *("COVERAGE_PROCESS_START", "COVERAGE_PROCESS_CONFIG", "LD_PRELOAD", "LD_AUDIT"),
    *("PYTHONINSPECT", "PYTHONPROFILEIMPORTTIME", "PYTHONVERBOSE"),
)
# Limits of the address space count what the server has loaded; that of the stack decides where things are in it.
_OF_MEMORY = ("as", "data", "stack", "memlock")
_BEGINNING = 65536  # bytes of a script in which it is looked for what it imports
# What few processes have, each of which speaks against it or may (`_outward`), and what all others have.
_outside = attrgetter("shell", "prefix", "inherit_environment", "stdin", "limits")
_PLAIN = (False, (), True, None, None)
_LONGEST_NAME = 15  # of a process (prctl(2), PR_SET_NAME)
_ENV = "/usr/bin/env"


class Program(NamedTuple):
    """How a program is run that is written in Python, as `Warm` says; `imports` tells whether it speaks of rclpy."""

    kind: Literal["script", "module"]
    target: str
    interpreter: tuple[str, ...]
    executable: str
    skip: int
    comm: str
    imports: bool


def wish(wanted: bool | None) -> Warm | None:
    """Return what the description says of it, until `warmed` decides."""
    return None if wanted is None else Warm(wanted, None if wanted else NOT_WANTED)


def warmed(plan: Plan, environment: Mapping[str, str]) -> Plan:
    """Return the plan with `warm` in each process; `environment` is the one in which it is started."""
    warmth = Warmth(environment)
    return replace(
        plan,
        processes=tuple(
            replace(process, warm=warmth.of(process, process.warm, process.command, process.environment))
            for process in plan.processes
        ),
    )


class Warmth:
    """Decides about the processes of a plan; `environment` is the one in which they are started."""

    __slots__ = ("_alike", "_environment", "_general", "_programs", "_search_path")

    def __init__(self, environment: Mapping[str, str]) -> None:
        self._environment = environment
        self._general = _general(environment)
        self._search_path = cache(lambda: _search_path(environment))
        self._programs: dict[tuple[str, ...], tuple[Warm, bool]] = {}
        # Of processes of which nothing speaks against it: by their kinds, folders, what commands begin with, variables.
        self._alike: dict[tuple[object, ...], Warm] = {}

    def of(
        self,
        process: Process | ResolvedProcess,
        wished: Warm | None,
        command: tuple[str, ...],
        own: Mapping[str, str | None],
    ) -> Warm:
        """Decide about one process, by what is wished, its command and its own environment."""
        if wished is not None and not wished.warm:
            return wished
        if wished is not None or _outside(process) != _PLAIN:
            return self._decide(process, wished, command, own)
        key = (process.kind, process.cwd, *command[:3], *own.items())
        known = self._alike.get(key)
        if known is None:
            known = self._alike[key] = self._decide(process, None, command, own)
        return known

    def _decide(
        self,
        process: Process | ResolvedProcess,
        wished: Warm | None,
        command: tuple[str, ...],
        own: Mapping[str, str | None],
    ) -> Warm:
        reason = _outward(process, command) or (own and self._by_environment(own)) or self._general
        if reason:
            return Warm(False, reason)
        path = (own["PATH"] if "PATH" in own else self._search_path()) or os.defpath
        warm, imports = self._program(command, process.cwd, path)
        if process.kind == "process" and wished is None and warm.warm and not imports:
            return Warm(False, "it is no node, and says nothing of rclpy")
        return warm

    def _program(self, command: tuple[str, ...], cwd: str | None, path: str) -> tuple[Warm, bool]:
        """Look at the program of a command, once for all that differ behind it."""
        # As many words as may say which program it is: those behind an interpreter do.
        words = 3 if _is_python(command[0]) else 1
        key = (path, cwd or "", *command[:words])
        program = self._programs.get(key)
        if program is None:
            found = once(("warm", os.getcwd(), *key), lambda: _program(command, cwd, path))  # noqa: PTH109 - a word
            program = self._programs[key] = _decided(found)
        return program

    def _by_environment(self, own: Mapping[str, str | None]) -> str | None:
        for name, value in own.items():
            if is_read_at_startup(name) and self._environment.get(name) != value:
                return f"its environment has another {name}, which is read before a program begins"
        return None


def _decided(program: Program | str) -> tuple[Warm, bool]:
    """Return whether and how a program is started, and whether it imports what nodes do."""
    if isinstance(program, str):
        return Warm(False, program), False
    how = (program.kind, program.target, program.interpreter, program.executable, program.skip, program.comm)
    return Warm(True, None, *how), program.imports


def _general(environment: Mapping[str, str]) -> str | None:
    """Return why nothing can be started warm."""
    watching = next((name for name in _FROM_THE_START if environment.get(name)), None)
    if watching:
        return f"the environment has {watching}, which acts from the start of an interpreter"
    if not once(("rclpy", *sys.path), _has_rclpy):
        return "this interpreter has no rclpy"
    return None


def _has_rclpy() -> bool:
    return any(os.path.isdir(os.path.join(folder, "rclpy")) for folder in sys.path)  # noqa: PTH112, PTH118 - pathlib is slow


def _outward(process: Process | ResolvedProcess, command: tuple[str, ...]) -> str | None:
    """Return what about the process itself speaks against it."""
    if not command:
        return "it has no command"
    if process.shell:
        return "a shell reads its command"
    if process.prefix:
        return "it has a launch prefix"
    if not process.inherit_environment:
        return "its environment is its own"
    if process.stdin:
        return "it reads what is typed"
    limits = process.limits
    if limits is not None and limits.memory is not None:
        return "its memory is capped, and what it shares with the server would not count"
    if limits is not None and any(name in limits.rlimits for name in _OF_MEMORY):
        return "its limits on memory would count what the server has loaded"
    return None


def _program(command: tuple[str, ...], cwd: str | None, path: str) -> Program | str:
    """Return how a command runs a program in Python, or why it is none that can be started warm."""
    if cwd is not None and "${" in cwd:
        return "its working directory is not there yet"
    word = command[0]
    found = word if "/" in word else program_on_path(word, {"PATH": path})
    if found is None:
        return "its program is not here"
    if "${" in found:
        return "its program is not here"
    whole = os.path.join(cwd or os.getcwd(), found)  # noqa: PTH109, PTH118 - pathlib is slow
    if _is_ours(whole):
        return _called(command, whole, cwd)
    return _script(found if "/" in word else None, whole, path)


def _called(command: tuple[str, ...], executable: str, cwd: str | None) -> Program | str:
    """Return the program that our interpreter is called with."""
    if len(command) < 2 or (command[1].startswith("-") and command[1] != "-m"):  # noqa: PLR2004 - the interpreter and it
        return "its interpreter is called with options of its own"
    name = os.path.basename(command[0])  # noqa: PTH119 - as above
    comm = name[:_LONGEST_NAME]
    folder = cwd or os.getcwd()  # noqa: PTH109 - as above
    if command[1] != "-m":
        target = os.path.join(folder, command[1])  # noqa: PTH118 - as above
        if not os.path.isfile(target):  # noqa: PTH113 - as above
            return "its script is no file that is here"
        return Program("script", target, (command[0],), executable, 1, comm, _speaks_of_rclpy(target))
    if len(command) < 3 or not all(part.isidentifier() for part in command[2].split(".")):  # noqa: PLR2004 - and its name
        return "it names no module"
    return Program("module", command[2], (command[0],), executable, 1, comm, imports=False)


def _script(word: str | None, path: str, search_path: str) -> Program | str:
    """Return the program that a file is; `word` is what the command line has for it, None where it was searched for."""
    first = _first_line(path)
    if not first.startswith(b"#!"):
        return "its program is not written in Python"
    words = [] if first.endswith(b"\r") else os.fsdecode(first[2:]).split()
    if len(words) == 2 and words[0] == _ENV and "/" not in words[1]:  # noqa: PLR2004 - env and a name
        called, by_name = words[1], program_on_path(words[1], {"PATH": search_path})
        executable, comm = by_name or "", called
    elif len(words) == 1:
        called = executable = words[0]
        comm = os.path.basename(path)  # noqa: PTH119 - as above
    else:
        return "its first line is no plain call of an interpreter"
    if not executable or not _is_ours(executable):
        return (
            "its interpreter is another one" if "python" in called else "its program is not written in Python"
        )
    interpreter = (called,) if word is not None else (called, path)
    skip = 0 if word is not None else 1
    return Program(
        "script", path, interpreter, executable, skip, comm[:_LONGEST_NAME], _speaks_of_rclpy(path)
    )


def _is_python(executable: str) -> bool:
    """Tell whether a program is called as interpreters of Python are."""
    return executable.rpartition("/")[2].startswith("python")


def _is_ours(executable: str) -> bool:
    """Tell whether a path leads to the interpreter that runs us: the same file, in the same environment."""
    if not _is_python(executable):
        return False
    if os.path.realpath(executable) != os.path.realpath(sys.executable):
        return False
    folder, ours = os.path.dirname(executable), os.path.dirname(sys.executable)  # noqa: PTH120 - as above
    if sys.prefix != sys.base_prefix:
        return os.path.realpath(folder) == os.path.realpath(ours)
    return not any(os.path.exists(f"{folder}/{place}pyvenv.cfg") for place in ("", "../"))  # noqa: PTH110 - as above


def _first_line(path: str) -> bytes:
    try:
        with open(path, "rb", buffering=0) as file:  # noqa: PTH123 - as above
            return file.read(256).partition(b"\n")[0]
    except OSError:
        return b""


def _speaks_of_rclpy(path: str) -> bool:
    try:
        with open(path, "rb") as file:  # noqa: PTH123 - as above
            return b"rclpy" in file.read(_BEGINNING)
    except OSError:
        return False


def _search_path(environment: Mapping[str, str]) -> str:
    """Return PATH as nodes have it: with a virtual environment's own folder (`supervise.environment`)."""
    path = environment.get("PATH", "")
    folder = os.path.join(sys.prefix, "bin")  # noqa: PTH118 - as above
    if sys.prefix == sys.base_prefix or folder in path.split(os.pathsep):
        return path
    return f"{folder}{os.pathsep}{path}"

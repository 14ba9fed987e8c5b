"""How much it weighs that this machine lacks what another one may have: the one place where that is decided.

| what is lacking                  | launch | plan    | check                                                   |
|----------------------------------|--------|---------|---------------------------------------------------------|
| a package, and what comes in one | error  | warning | a note; a warning where a workspace is sourced          |
| a program of the PATH            | error  | warning | a note                                                  |
| an environment variable          | error  | error   | a note                                                  |
| a file of the machine            | error  | error   | a note                                                  |
| what runs, for a command         | error  | error   | a note                                                  |
| what code asks of the machine    | error  | error   | a note                                                  |
| the working directory            | error  | error   | a note                                                  |
| a required argument              | error  | error   | a note; an error where arguments are given              |

What comes in packages are their executables, components, Python modules and actions, and interpreters. A program of the
PATH, such as xacro, is started for what it gives. A file of the machine is neither in the project of the launch file
nor where packages are. Code asks the machine for devices, networks, and what programs tell of them. What runs is asked
for by `ros2 param get` and its like. From another working directory a relative path may lead to a file: one of the
folders above the launch file has it. Where a workspace is sourced, what the files need of packages should be in it. A
name that is hardly anything but a slip for one that is here is an error in any case: that is decided where the names
are known.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code, Severity
from orchestra.fields import field

_SOURCED: Final = "AMENT_PREFIX_PATH"
_OUTSIDE: Final = (Code.UNSET_ENVIRONMENT, Code.MISSING_FILE, Code.COMMAND_FAILED)  # which no workspace has


@dataclass(frozen=True, slots=True)
class Weights:
    """The column of the table that counts; the environment is that of the caller."""

    environment: Mapping[str, str] = field(default_factory=dict)
    launching: bool = True
    planning: bool = True
    with_arguments: bool = False

    @property
    def package(self) -> Severity:
        """How much a package weighs that is not here, and what comes in one."""
        if self.launching:
            return Severity.ERROR
        # Not asked for where it decides nothing: what is kept depends on what is asked for.
        is_note = not self.planning and not self.environment.get(_SOURCED)
        return Severity.NOTE if is_note else Severity.WARNING

    @property
    def program(self) -> Severity:
        """How much a program weighs that is not on the PATH, which no workspace need have."""
        if self.launching:
            return Severity.ERROR
        return Severity.WARNING if self.planning else Severity.NOTE

    @property
    def variable(self) -> Severity:
        """How much an environment variable weighs that is not set."""
        return Severity.ERROR if self.planning else Severity.NOTE

    @property
    def argument(self) -> Severity:
        """How much a required argument of the first file weighs that nobody gives."""
        return Severity.ERROR if self.planning or self.with_arguments else Severity.NOTE

    def of(self, code: Code) -> Severity:
        """Return how much it weighs that code of a file, or an action of it, goes no further for such a lack."""
        if code is Code.MISSING_EXECUTABLE:
            return self.program
        return self.variable if code in _OUTSIDE else self.package

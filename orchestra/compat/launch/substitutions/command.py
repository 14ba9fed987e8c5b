"""`Command`: what a command prints."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.described import described
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class Command(ParsedSubstitution):
    """The output of a command that is split by shell rules and run without a shell, the final line break taken away.

    `on_stderr` is `fail`, `ignore`, `warn` or `capture`: what output on standard error means. Upstream keeps the line
    break.
    """

    _name = "command"
    _parameters = ("command", "on_stderr")

    def __init__(self, command: Sub, *, on_stderr: Sub = "fail") -> None:
        super().__init__()
        self.__command = normalized(command)
        self.__on_stderr = normalized(on_stderr)

    @property
    def command(self) -> list[Substitution]:
        """The command."""
        return self.__command

    @property
    def on_stderr(self) -> list[Substitution]:
        """What output on standard error means."""
        return self.__on_stderr

    def describe(self) -> str:
        """Return the command and what it is."""
        return f"Command({described(self.command)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.command,) if described(self.on_stderr) == "'fail'" else (self.command, self.on_stderr)

"""`FindExecutable`: a program on the PATH."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.described import described
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class FindExecutable(ParsedSubstitution):
    """The absolute path of a program on the PATH."""

    _name = "find-exec"
    _parameters = ("name",)

    def __init__(self, *, name: Sub) -> None:
        super().__init__()
        self.__name = normalized(name)

    @property
    def name(self) -> list[Substitution]:
        """The name of the program."""
        return self.__name

    def describe(self) -> str:
        """Return the name and what it is."""
        return f"FindExec({described(self.name)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.name,)

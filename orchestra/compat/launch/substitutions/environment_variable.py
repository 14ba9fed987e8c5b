"""`EnvironmentVariable`: the value of an environment variable."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.described import described
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class EnvironmentVariable(ParsedSubstitution):
    """The value in the environment of the scope, else the default."""

    _name = "env"
    _parameters = ("name", "default_value")

    def __init__(self, name: Sub, *, default_value: Sub | None = None) -> None:
        super().__init__()
        self.__name = normalized(name)
        self.__default_value = None if default_value is None else normalized(default_value)

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """What stands for a variable that is not set, None: that is an error."""
        return self.__default_value

    def describe(self) -> str:
        """Return the name and what it is."""
        return f"EnvVar({described(self.name)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.name,) if self.default_value is None else (self.name, self.default_value)

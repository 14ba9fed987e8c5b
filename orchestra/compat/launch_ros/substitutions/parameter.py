"""`Parameter`: a parameter that `SetParameter` has put in scope."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.described import described
from orchestra.compat.launch.substitutions.launch_configuration import _texts
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class Parameter(ParsedSubstitution):
    """The value as text, else the default, which may be any scalar. Parameter files are not searched."""

    _name = "param"
    _parameters = ("name", "default")

    def __init__(self, name: Sub, *, default: Any = None) -> None:
        super().__init__()
        self.__name = normalized(name)
        self.__default = None if default is None else normalized(_texts(default))

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    def describe(self) -> str:
        """Return the name and what it is."""
        return f"Parameter(name={described(self.name)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        return (self.name,) if self.__default is None else (self.name, self.__default)

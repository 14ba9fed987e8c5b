"""`LaunchConfiguration`: the value of a launch argument or variable."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from orchestra.compat.described import described
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.place import here
from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.text import Template


class LaunchConfiguration(ParsedSubstitution):
    """The value, else the default: a scalar, which becomes a text, or substitutions, or several of both."""

    _name = "var"
    _parameters = ("variable_name", "default")

    def __init__(self, variable_name: Sub, *, default: Any = None) -> None:
        self._place = here(self)
        self.__variable_name = normalized(variable_name)
        self.__default = None if default is None else normalized(_texts(default))

    @property
    def variable_name(self) -> list[Substitution]:
        """The name."""
        return self.__variable_name

    def describe(self) -> str:
        """Return the name and what it is."""
        return f"LaunchConfig({described(self.variable_name)})"

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        name = self.variable_name
        return (name,) if self.__default is None else (name, self.__default)

    def _whole(self) -> Template | None:
        kept = self._kept
        if kept is None or self.__default is not None:
            return super()._whole()
        # As there, at once: launch files have thousands of these.
        same = kept[0][0] == self.__variable_name and kept[2] is self._place
        return kept[1] if same else super()._whole()


def _texts(default: Any) -> Any:
    """Return a default with its scalars as texts."""
    if isinstance(default, bool | int | float):
        return str(default)
    if isinstance(default, Iterable) and not isinstance(default, str):
        return [str(item) if isinstance(item, bool | int | float) else item for item in default]
    return default

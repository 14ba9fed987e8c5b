"""`LaunchConfiguration`: the value of a launch argument or variable."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.calls import variable
from orchestra.compat.described import described
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.place import IN_CONSTRUCTOR, here
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
    # What the variable alone is as a text, as long as no code has had the list of what its name is made of.
    _sure: Template | None = None
    __is_shown = False

    def __init__(self, variable_name: Sub, *, default: Any = None) -> None:
        self._place = here(self, IN_CONSTRUCTOR)
        self.__variable_name = normalized(variable_name)
        self.__default = None if default is None else normalized(_texts(default))

    @property
    def variable_name(self) -> list[Substitution]:
        """The name."""
        self._sure = None
        self.__is_shown = True
        return self.__variable_name

    def describe(self) -> str:
        """Return the name and what it is."""
        return f"LaunchConfig({described(self.__own_name())})"

    def __own_name(self) -> list[Substitution]:
        """Return the name without showing it to anybody; a user's subclass may say another one."""
        return self.__variable_name if type(self) is LaunchConfiguration else self.variable_name

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        name = self.__own_name()
        return (name,) if self.__default is None else (name, self.__default)

    def _alone(self) -> str | None:
        """Return the name where the variable is all there is, and nobody's code says what it comes to."""
        name = self.__variable_name
        if self.__default is not None or len(name) != 1 or type(self).perform is not PERFORM:
            return None
        return name[0].text or None if type(name[0]) is TextSubstitution else None

    def _whole(self) -> Template | None:
        if self._sure is not None and type(self).perform is PERFORM:
            return self._sure
        name, place, kept = self.__variable_name, self._place, self._kept
        if self.__default is not None or type(self).perform is not PERFORM:
            return super()._whole()
        # As there, at once: launch files have thousands of these.
        if kept is not None and kept[0][0] == name and kept[2] is place:
            return kept[1]
        if type(self) is not LaunchConfiguration or len(name) != 1 or type(name[0]) is not TextSubstitution:
            return super()._whole()
        text = name[0].text
        if not text:
            return super()._whole()
        made = variable(text, place)
        self._kept = (list(name),), made, place
        if not self.__is_shown:
            self._sure = made
        return made


PERFORM: Final = LaunchConfiguration.perform


def _texts(default: Any) -> Any:
    """Return a default with its scalars as texts."""
    if isinstance(default, bool | int | float):
        return str(default)
    if isinstance(default, Iterable) and not isinstance(default, str):
        return [str(item) if isinstance(item, bool | int | float) else item for item in default]
    return default

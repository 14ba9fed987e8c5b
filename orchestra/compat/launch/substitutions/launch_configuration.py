"""`LaunchConfiguration`: the value of a launch argument or variable."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.calls import own
from orchestra.compat.described import described
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.parsed import ParsedSubstitution
from orchestra.compat.place import IN_CONSTRUCTOR, here
from orchestra.compat.text import normalized, perform_alike, shown

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


class LaunchConfiguration(ParsedSubstitution):
    """The value, else the default: a scalar, which becomes a text, or substitutions, or several of both."""

    _name = "var"
    _parameters = ("variable_name", "default")
    __variable_name: list[Substitution] = own()
    __default: list[Substitution] | None = own()

    def __init__(self, variable_name: Sub, *, default: Any = None) -> None:
        self._place = here(self, IN_CONSTRUCTOR)
        self.__variable_name = normalized(variable_name)
        self.__default = None if default is None else normalized(_texts(default))
        name = self.__variable_name
        if default is None and len(name) == 1 and type(name[0]) is TextSubstitution and name[0].text:
            self._known_as = (self._name, name[0].text) if type(self) is LaunchConfiguration else None

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        if keywords or len(arguments) != 1:
            return False
        (name,) = arguments
        if type(name) is not str or not name:
            return False
        self._as_given = arguments, keywords
        self._known_as = "var", name
        return True

    def _given_again(self) -> tuple[tuple[Any, ...], dict[str, Any]]:
        return (self._known_as[1],), {}

    @property
    def variable_name(self) -> list[Substitution]:
        """The name."""
        name = self.__variable_name
        shown[0] += 1
        self._forget()
        return name

    def describe(self) -> str:
        """Return the name and what it is."""
        return f"LaunchConfig({described(self.__own_name())})"

    def _is_noted(self) -> bool:
        if self._known_as is not None:
            return True
        if type(self) is not LaunchConfiguration:
            return False
        name, default = self.__variable_name, self.__default
        return _TEXTS.issuperset(map(type, name if default is None else name + default))

    def __own_name(self) -> list[Substitution]:
        """Return the name without showing it to anybody; a user's subclass may say another one."""
        return self.__variable_name if type(self) is LaunchConfiguration else self.variable_name

    def _arguments(self) -> Sequence[Sequence[Substitution]]:
        name = self.__own_name()
        return (name,) if self.__default is None else (name, self.__default)

    def _alone(self) -> str | None:
        """Return the name where the variable is all there is, and nobody's code says what it comes to."""
        known = self._known_as
        return None if known is None or type(self).perform is not PERFORM else known[1]


_TEXTS: Final = frozenset({TextSubstitution})
PERFORM: Final = LaunchConfiguration.perform
perform_alike(LaunchConfiguration)


def _texts(default: Any) -> Any:
    """Return a default with its scalars as texts."""
    if isinstance(default, bool | int | float):
        return str(default)
    if isinstance(default, Iterable) and not isinstance(default, str):
        return [str(item) if isinstance(item, bool | int | float) else item for item in default]
    return default

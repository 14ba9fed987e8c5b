"""`EqualsSubstitution`: whether two values are equal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.calculating import plain
from orchestra.compat.launch.substitutions.two_sided import TwoSided
from orchestra.compat.launch.utilities.type_utils import is_substitution
from orchestra.compat.place import here
from orchestra.compat.refusing import collector

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class EqualsSubstitution(TwoSided):
    """True where both are equal: as booleans where both are, else as numbers, else as text.

    A side is a substitution, or several with texts, or any Python value: None is an empty text, the rest its `str`.
    """

    _name = "equals"

    def __init__(self, left: Any, right: Any) -> None:
        super().__init__(_side(left), _side(right))
        if type(left) is str and type(right) is str and collector() is not None:
            from orchestra.compat.constant_sides import tell_constant_sides  # noqa: PLC0415 - few compare two texts

            tell_constant_sides(here(self), type(self).__name__)

    def _keep(self, arguments: tuple[Any, ...], keywords: dict[str, Any]) -> bool:
        if all(type(side) is str for side in arguments):
            return False  # of which there may be something to tell
        if any(type(side) is list and not is_substitution(side) for side in arguments):
            return False  # its `str` counts
        return super()._keep(arguments, keywords)


plain.add(EqualsSubstitution)


def _side(value: Any) -> Sub:
    if is_substitution(value):
        side: Sub = value
        return side
    if value is None:
        return ""
    return str(value).lower() if isinstance(value, bool) else str(value)

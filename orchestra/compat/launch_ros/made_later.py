"""What is constructed from its arguments when somebody asks for more than its model."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.place import Place, standing
from orchestra.compat.refusing import Refusing


class Made:
    """The fields of a model, and the arguments of which they were made, with lists and dictionaries of its own."""

    __slots__ = ("fields", "given")

    def __init__(self, fields: dict[str, Any], given: dict[str, Any]) -> None:
        self.fields = fields
        self.given = given


class MadeLater(Refusing):
    """An object that has a place, and `_plain` until it is constructed."""

    _place: Place

    if not TYPE_CHECKING:  # else any attribute would be one

        def __getattr__(self, name: str) -> Any:
            """Return what the constructor makes."""
            if "_plain" not in vars(self):
                return super().__getattr__(name)
            self._construct()
            return getattr(self, name)

    def _construct(self) -> None:
        """Do what the constructor does; what users have set since stays."""
        own = vars(self)
        made: Made = own.pop("_plain")
        self.__dict__ = {}
        with standing(own["_place"]):
            self.__init__(**made.given)  # type: ignore[misc] # with the keywords of the subclass
        vars(self).update(own)

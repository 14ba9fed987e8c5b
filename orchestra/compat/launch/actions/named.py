"""What the actions share that set something by its name, or remove it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar

from orchestra.compat.building import made_of
from orchestra.compat.launch.plain_action import PlainAction, text_at
from orchestra.compat.text import normalized, template

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.place import Arguments
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class NamedAction(PlainAction):
    """An action on what has a name; a subclass says in which model."""

    _model: ClassVar[type[Model]]

    def __init__(self, name: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalized(name)

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    def _made(self, common: Mapping[str, Any]) -> Model:
        return made_of(self._model, self._place, self._fields(), common)

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        return self._model, {name: text_at(value, call, name) for name, value in given.items()}

    def _fields(self) -> dict[str, Any]:
        """Return the fields of the model that it alone has."""
        return {"name": template(self.name, self._place.at("name"))}


class SettingAction(NamedAction):
    """An action that gives it a value."""

    def __init__(self, name: Sub, value: Sub, **kwargs: Any) -> None:
        super().__init__(name, **kwargs)
        self.__value = normalized(value)

    @property
    def value(self) -> list[Substitution]:
        """The value."""
        return self.__value

    def _fields(self) -> dict[str, Any]:
        return {**super()._fields(), "value": template(self.value, self._place.at("value"))}

"""`SetParameter`: sets a parameter of every node."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.building import made_of
from orchestra.compat.launch.plain_action import PlainAction, is_text, text_at
from orchestra.compat.launch_ros.models import params_of, value_fields
from orchestra.compat.launch_ros.utilities.normalize_parameters import normalize_parameter_dict
from orchestra.compat.place import argument
from orchestra.compat.text import normalized, template
from orchestra.description.actions.set_parameter import SetParameter as SetParameterModel
from orchestra.description.text import new_constant

if TYPE_CHECKING:
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.place import Arguments
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class SetParameter(PlainAction):
    """Set a parameter of every node that follows in this scope; a dictionary sets several.

    Raises `TypeError` for a value that no parameter can have.
    """

    _plain = (2, ("name", "value"))

    def __init__(self, name: Sub, value: Any, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__name = normalized(name)
        self.__value = value
        self.__param_dict = normalize_parameter_dict({tuple(self.__name): value})

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def value(self) -> Any:
        """The value, as it was given."""
        return self.__value

    def _is_plain(self, given: dict[str, Any]) -> bool:
        return given.keys() == _PLAIN and type(given["value"]) in _SCALARS and is_text(given, "name")

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        value = new_constant(given["value"], argument(call.place, ("value",)))
        return SetParameterModel, {"name": text_at(given["name"], call, "name"), "value": value}

    def _made(self, common: Mapping[str, Any]) -> Model:
        place = self._place
        name, at = template(self.name, place.at("name")), place.at("value")
        if isinstance(self.__value, Mapping):
            nested = params_of(normalize_parameter_dict(self.__value), at)
            return SetParameterModel.at(place.span, name=name, param=nested, **common)
        (value,) = self.__param_dict.values()
        fields = {"name": name, **value_fields(value, at)}
        if "type" in fields:  # which may be one that there is not
            return SetParameterModel.at(place.span, **fields, **common)
        return made_of(SetParameterModel, place, fields, common)


_PLAIN: Final = {"name", "value"}
_SCALARS: Final = frozenset({bool, int, float, str})

"""`SetParametersFromFile`: gives a parameter file to every node."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import normalized, template
from orchestra.description.actions.set_parameters_from_file import (
    SetParametersFromFile as SetParametersFromFileModel,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class SetParametersFromFile(ModelledAction):
    """Give a parameter file to every node that follows in this scope, before the node's own parameters."""

    def __init__(self, filename: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__filename = normalized(filename)

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        filename = template(self.__filename, self._place.at("filename"))
        return SetParametersFromFileModel.at(self._place.span, filename=filename, **common)

"""`AppendEnvironmentVariable`: adds to an environment variable."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.actions.named import SettingAction
from orchestra.compat.text import normalized, template
from orchestra.compat.values import scalar
from orchestra.description.actions.append_env import AppendEnv

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class AppendEnvironmentVariable(SettingAction):
    """Add a value to an environment variable for what follows in this scope; set it where it is unset."""

    _model = AppendEnv

    def __init__(
        self,
        name: Sub,
        value: Sub,
        prepend: bool | Sub = False,
        separator: Sub = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(name, value, **kwargs)
        self.__prepend = prepend if isinstance(prepend, bool) else normalized(prepend)
        self.__separator = normalized(separator)
        if isinstance(prepend, str):
            from orchestra.compat.refused_upstream import tell_text_of_truth  # noqa: PLC0415 - only mistakes need it

            tell_text_of_truth("prepend", prepend, self._place)

    @property
    def prepend(self) -> bool | list[Substitution]:
        """Whether it goes in front."""
        return self.__prepend

    @property
    def separator(self) -> list[Substitution]:
        """What stands between the old and the new."""
        return self.__separator

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return self._model.at(
            self._place.span, **self._fields(), **common
        )  # it may say other than true or false

    def _fields(self) -> dict[str, Any]:
        place = self._place
        separator = template(self.separator, place.at("separator"))
        return {
            **super()._fields(),
            "prepend": None if self.prepend is False else scalar(self.prepend, place.at("prepend")),
            "separator": None if separator.constant == os.pathsep else separator,
        }

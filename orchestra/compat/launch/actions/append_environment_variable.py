"""`AppendEnvironmentVariable`: adds to an environment variable."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import normalized, template
from orchestra.compat.values import scalar
from orchestra.description.actions.append_env import AppendEnv

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class AppendEnvironmentVariable(ModelledAction):
    """Add to an environment variable for what follows in this scope; set it where it is unset."""

    def __init__(
        self,
        name: Sub,
        value: Sub,
        prepend: bool | Sub = False,
        separator: Sub = os.pathsep,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        self.__name = normalized(name)
        self.__value = normalized(value)
        self.__prepend = prepend if isinstance(prepend, bool) else normalized(prepend)
        self.__separator = normalized(separator)

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def value(self) -> list[Substitution]:
        """What is added."""
        return self.__value

    @property
    def prepend(self) -> bool | list[Substitution]:
        """Whether it goes in front."""
        return self.__prepend

    @property
    def separator(self) -> list[Substitution]:
        """What stands between the old and the new."""
        return self.__separator

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        separator = template(self.separator, span)
        return AppendEnv.at(
            span,
            name=template(self.name, span),
            value=template(self.value, span),
            prepend=None if self.prepend is False else scalar(self.prepend, span),
            separator=None if separator.constant == os.pathsep else separator,
            **common,
        )

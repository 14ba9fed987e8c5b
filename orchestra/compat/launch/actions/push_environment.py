"""`PushEnvironment`: remembers the environment."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.description.actions.stacks import PushEnvironment as PushEnvironmentModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action as Model


class PushEnvironment(ModelledAction):
    """Save the environment."""

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return PushEnvironmentModel.at(self._place.span, **common)

"""`ResetEnvironment`: undoes changes of the environment."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.description.actions.reset_env import ResetEnv

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action as Model


class ResetEnvironment(ModelledAction):
    """Make the environment what it was when the launch began."""

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return ResetEnv.at(self._place.span, **common)

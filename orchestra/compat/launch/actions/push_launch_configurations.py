"""`PushLaunchConfigurations`: remembers the launch configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.description.actions.stacks import PushLaunchConfigurations as PushLaunchConfigurationsModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action as Model


class PushLaunchConfigurations(ModelledAction):
    """Save the launch configurations; the present ones stay in force."""

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return PushLaunchConfigurationsModel.at(self._place.span, **common)

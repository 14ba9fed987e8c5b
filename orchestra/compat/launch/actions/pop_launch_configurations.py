"""`PopLaunchConfigurations`: takes up launch configurations again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.description.actions.stacks import PopLaunchConfigurations as PopLaunchConfigurationsModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action as Model


class PopLaunchConfigurations(ModelledAction):
    """Restore the launch configurations that were saved last."""

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return PopLaunchConfigurationsModel.at(self._place.span, **common)

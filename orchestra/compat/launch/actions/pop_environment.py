"""`PopEnvironment`: takes up the environment again."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.description.actions.stacks import PopEnvironment as PopEnvironmentModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action as Model


class PopEnvironment(ModelledAction):
    """Restore the environment that was saved last."""

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return PopEnvironmentModel.at(self._place.span, **common)

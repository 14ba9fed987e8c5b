"""`ResetLaunchConfigurations`: forgets launch configurations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.values import pairs
from orchestra.description.actions.reset import Reset

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class ResetLaunchConfigurations(ModelledAction):
    """Forget all launch configurations, then set those that are given, which are evaluated before."""

    _role = "reset"

    def __init__(self, launch_configurations: Mapping[Sub, Sub] | None = None, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__launch_configurations = dict(launch_configurations or {})

    @property
    def launch_configurations(self) -> Mapping[Sub, Sub]:
        """What is set afterwards."""
        return self.__launch_configurations

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        kept = pairs(self.launch_configurations.items(), self._place.at("launch_configurations"))
        return Reset.at(self._place.span, keep=kept, **common)

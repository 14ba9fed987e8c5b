"""`SetROSLogDir`: where nodes write their own logs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import normalized, template
from orchestra.description.actions.set_ros_log_dir import SetRosLogDir as SetRosLogDirModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class SetROSLogDir(ModelledAction):
    """Set the folder for the logs of nodes that follow in this scope; a relative one is below the present one."""

    def __init__(self, new_log_dir: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__log_dir = normalized(new_log_dir)

    @property
    def log_dir(self) -> list[Substitution]:
        """The folder."""
        return self.__log_dir

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        folder = template(self.log_dir, self._place.at("new_log_dir"))
        return SetRosLogDirModel.at(self._place.span, new_log_dir=folder, **common)

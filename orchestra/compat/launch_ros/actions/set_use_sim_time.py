"""`SetUseSimTime`: the clock of `ROSTimer`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import normalized
from orchestra.compat.values import scalar
from orchestra.description.actions.set_use_sim_time import SetUseSimTime as SetUseSimTimeModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class SetUseSimTime(ModelledAction):
    """Let `ROSTimer` go by simulated time; nodes take `SetParameter("use_sim_time", True)`."""

    def __init__(self, value: bool | Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__value = value if isinstance(value, bool) else normalized(value)

    @property
    def value(self) -> bool | list[Substitution]:
        """Whether time is simulated."""
        return self.__value

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        value = scalar(self.value, self._place.at("value"))
        return SetUseSimTimeModel.at(self._place.span, value=value, **common)

"""`ReadyToTest`: the place in a description where its tests may begin."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.description.actions.group import Group

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action as Model


class ReadyToTest(ModelledAction):
    """Mark the place. A run without tests does nothing there."""

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        return Group.at(self._place.span, children=(), **common)

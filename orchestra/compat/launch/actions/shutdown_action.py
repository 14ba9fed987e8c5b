"""The action that ends the run; the event of the same name is in `launch.events`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.actions.emit_event import EmitEvent
from orchestra.compat.launch.events.shutdown import Shutdown as ShutdownEvent
from orchestra.compat.refusing import is_lost
from orchestra.compat.text import normalized, template
from orchestra.description.actions.shutdown import Shutdown as ShutdownModel

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model

_NO_REASON = "reason not given"


class Shutdown(EmitEvent):
    """End the run."""

    def __init__(self, *, reason: Sub = _NO_REASON, **kwargs: Any) -> None:
        self.__reason = normalized(reason)
        super().__init__(event=ShutdownEvent(reason=reason), **kwargs)

    @property
    def _has_reason(self) -> bool:
        """Whether somebody has said why."""
        return template(self.__reason, self._place.span).constant != _NO_REASON

    @property
    def _says_more(self) -> bool:
        """Whether anything is said but that the run ends, whenever this is visited."""
        described = self._is_as_described() and not self._refused and not is_lost(self)
        return not described or self.condition is not None or self._has_reason

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        given = template(self.__reason, self._place.at("reason")) if self._has_reason else None
        return ShutdownModel.at(self._place.span, reason=given, **common)

"""`LogInfo`: tells the user something."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.plain_action import PlainAction, text_at
from orchestra.compat.text import normalized, template
from orchestra.description.actions.log import Log

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.place import Arguments
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class LogInfo(PlainAction):
    """Print a message when the action is visited."""

    _plain = (0, ("msg",))

    def __init__(self, *, msg: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__msg = normalized(msg)

    @property
    def msg(self) -> list[Substitution]:
        """The message."""
        return self.__msg

    def _read(self, given: dict[str, Any], call: Arguments) -> tuple[type[Model], dict[str, Any]]:
        return Log, {"message": text_at(given["msg"], call, "msg")}

    def _made(self, common: Mapping[str, Any]) -> Model:
        message = template(self.msg, self._place.at("msg"))
        return Log.at(self._place.span, message=message, **common)

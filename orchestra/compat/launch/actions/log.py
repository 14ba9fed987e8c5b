"""`Log` and what follows from it (newer ROS releases): tells the user something that matters more or less."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.launch.actions.log_info import LogInfo
from orchestra.compat.text import normalized, template
from orchestra.description.actions.log import Log as LogModel
from orchestra.description.text import Template, Words

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model

__all__ = ["Log", "LogDebug", "LogError", "LogInfo", "LogWarning"]


class Log(ModelledAction):
    """Print a message when the action is visited. `level` is `debug`, `info`, `warning` or `error`, in any case."""

    def __init__(self, *, msg: Sub, level: Sub, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self.__msg = normalized(msg)
        self.__level = normalized(level)

    @property
    def msg(self) -> list[Substitution]:
        """The message."""
        return self.__msg

    @property
    def level(self) -> list[Substitution]:
        """How much it matters."""
        return self.__level

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        span = self._place.at("level")
        level = template(self.level, span)
        word = level.constant
        if word is not None:
            level = Template((Words(word.lower(), span),), word.lower(), span)
        return LogModel.at(
            self._place.span, message=template(self.msg, self._place.at("msg")), level=level, **common
        )


class LogDebug(Log):
    """Print a message for those who look for a fault."""

    def __init__(self, *, msg: Sub, **kwargs: Any) -> None:
        super().__init__(msg=msg, level="debug", **kwargs)


class LogWarning(Log):
    """Print a warning."""

    def __init__(self, *, msg: Sub, **kwargs: Any) -> None:
        super().__init__(msg=msg, level="warning", **kwargs)


class LogError(Log):
    """Print an error; the run goes on."""

    def __init__(self, *, msg: Sub, **kwargs: Any) -> None:
        super().__init__(msg=msg, level="error", **kwargs)

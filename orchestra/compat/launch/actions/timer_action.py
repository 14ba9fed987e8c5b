"""`TimerAction`: actions after a while."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from orchestra.compat.building import models_of
from orchestra.compat.described import described
from orchestra.compat.explanation import told
from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import Sub, normalized
from orchestra.compat.values import scalar, written
from orchestra.compat.wrong import WrongType
from orchestra.description.actions.timer import Timer

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import ClassVar

    from orchestra.compat.launch.launch_context import LaunchContext
    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.description.entity import Action as Model


class TimerAction(ModelledAction):
    """Visit actions once, when `period` seconds are over.

    Raises `TypeError` for a period that is neither number nor text, and for actions that are no iterable.
    """

    _model: ClassVar[type[Timer]] = Timer

    def __init__(
        self,
        *,
        period: Sub | float,
        actions: Iterable[LaunchDescriptionEntity],
        cancel_on_shutdown: bool | Sub = True,
        **kwargs: Any,
    ) -> None:
        super().__init__(**kwargs)
        if not isinstance(actions, Iterable):
            raise WrongType(f"the actions of a timer are a list, this is {told(actions)}", path=("actions",))
        self.__period = float(period) if isinstance(period, int | float) else normalized(written(period))
        self.__actions = actions if isinstance(actions, list) else list(actions)
        self.__cancel_on_shutdown = cancel_on_shutdown
        self._is_cancelled = False
        if type(period) is not float:
            from orchestra.compat.refused_upstream import tell_no_float  # noqa: PLC0415 - few periods are texts

            tell_no_float(period, self._place)

    @property
    def period(self) -> float | list[Substitution]:
        """The seconds: a number where one was given."""
        return self.__period

    @property
    def actions(self) -> list[LaunchDescriptionEntity]:
        """The actions."""
        return self.__actions

    def cancel(self) -> None:
        """Let it not go off, at whatever time."""
        self._is_cancelled = True

    def describe(self) -> str:
        """Return what the timer is."""
        return f"{type(self).__name__}(period={self.__seconds()}, actions=<actions>)"

    def describe_conditional_sub_entities(self) -> list[tuple[str, Iterable[LaunchDescriptionEntity]]]:
        """Return the actions: they follow unless somebody cancels the timer."""
        return [(f"{self.__seconds()} seconds pass without being canceled", self.actions)]

    def execute(self, context: LaunchContext) -> list[LaunchDescriptionEntity] | None:
        """Start the timer unless it is cancelled."""
        return None if self._is_cancelled else super().execute(context)

    def handle(self, context: LaunchContext) -> list[LaunchDescriptionEntity]:  # noqa: ARG002 - for subclasses
        """Return what is to be visited when the time is over."""
        return self.actions

    def __seconds(self) -> str:
        period = self.period
        return str(period) if isinstance(period, float) else described(period)

    def _is_as_described(self) -> bool:
        return super()._is_as_described() and not self._is_cancelled

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        span = self._place.span
        cancelled = self.__cancel_on_shutdown
        return self._model.at(
            span,
            period=scalar(self.period, self._place.at("period")),
            cancel_on_shutdown=None
            if cancelled is True
            else scalar(cancelled, self._place.at("cancel_on_shutdown")),
            children=models_of(self.actions, self._place),
            **common,
        )

"""`StateTransition`: a lifecycle node has made a transition."""

from __future__ import annotations

from typing import Any

from orchestra.compat.launch.event import Event


class StateTransition(Event):
    """What `msg` (lifecycle_msgs/msg/TransitionEvent, or anything with its fields) says of the node of `action`."""

    name = "launch_ros.events.lifecycle.StateTransition"

    def __init__(self, *, action: Any, msg: Any) -> None:
        super().__init__()
        self.__action = action
        self.__msg = msg

    @property
    def action(self) -> Any:
        """The action that started the node."""
        return self.__action

    @property
    def msg(self) -> Any:
        """The message."""
        return self.__msg

    @property
    def timestamp(self) -> int:
        """When it was, in nanoseconds."""
        stamp: int = self.__msg.timestamp
        return stamp

    @property
    def transition(self) -> str:
        """The transition's label."""
        return str(self.__msg.transition.label)

    @property
    def start_state(self) -> str:
        """The label of the state before, as `inactive`."""
        return str(self.__msg.start_state.label)

    @property
    def goal_state(self) -> str:
        """The label of the state after."""
        return str(self.__msg.goal_state.label)

"""`ChangeState`: lifecycle nodes are asked to make a transition."""

from __future__ import annotations

from collections import OrderedDict
from typing import TYPE_CHECKING, Any, ClassVar

from orchestra.compat.launch.event import Event
from orchestra.compat.launch.events.matchers import checked_matcher
from orchestra.compat.wrong import WrongNumber

if TYPE_CHECKING:
    from collections.abc import Callable

_TRANSITIONS = (
    "CREATE",
    "CONFIGURE",
    "CLEANUP",
    "ACTIVATE",
    "DEACTIVATE",
    "UNCONFIGURED_SHUTDOWN",
    "INACTIVE_SHUTDOWN",
    "ACTIVE_SHUTDOWN",
    "DESTROY",
)
_PRIMARY_STATES = ("UNKNOWN", "UNCONFIGURED", "INACTIVE", "ACTIVE", "FINALIZED")
_TRANSITION_STATES = (
    "CONFIGURING",
    "CLEANINGUP",
    "SHUTTINGDOWN",
    "ACTIVATING",
    "DEACTIVATING",
    "ERRORPROCESSING",
)
_FIRST_TRANSITION_STATE = 10


class ChangeState(Event):
    """A transition for the lifecycle nodes that `lifecycle_node_matcher` holds for.

    `transition_id` and the keys of the tables are those of lifecycle_msgs. Raises `ValueError` for another id.
    """

    name = "launch_ros.events.lifecycle.ChangeState"
    valid_transitions: ClassVar[OrderedDict[int, str]] = OrderedDict(
        (number, f"TRANSITION_{word}") for number, word in enumerate(_TRANSITIONS)
    )
    valid_states: ClassVar[OrderedDict[int, str]] = OrderedDict(
        (
            *((number, f"PRIMARY_STATE_{word}") for number, word in enumerate(_PRIMARY_STATES)),
            *(
                (number, f"TRANSITION_STATE_{word}")
                for number, word in enumerate(_TRANSITION_STATES, _FIRST_TRANSITION_STATE)
            ),
        )
    )

    def __init__(self, *, lifecycle_node_matcher: Callable[[Any], bool], transition_id: int) -> None:
        super().__init__()
        if transition_id not in self.valid_transitions:
            known = ", ".join(f"{number} ({word})" for number, word in self.valid_transitions.items())
            message = f"{transition_id!r} is no transition of a lifecycle node, only: {known}"
            raise WrongNumber(message, transition_id, path=("transition_id",))
        self.__lifecycle_node_matcher = checked_matcher("lifecycle_node_matcher", lifecycle_node_matcher)
        self.__transition_id = transition_id

    @property
    def lifecycle_node_matcher(self) -> Callable[[Any], bool]:
        """The predicate on actions."""
        return self.__lifecycle_node_matcher

    @property
    def transition_id(self) -> int:
        """The transition."""
        return self.__transition_id

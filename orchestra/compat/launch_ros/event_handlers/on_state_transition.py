"""`OnStateTransition`: what is done when a lifecycle node makes a transition."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.building import models_of
from orchestra.compat.launch.event_handler import EventHandler, entities_of, is_of_ours
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.launch_ros.actions.lifecycle_node import LifecycleNode
from orchestra.compat.launch_ros.events.lifecycle.state_transition import StateTransition
from orchestra.compat.rewritten import Rewritten
from orchestra.compat.wrong import WrongRuntime, WrongType
from orchestra.description.conditions import STATES
from orchestra.errors import Code
from orchestra.nearest import nearest

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.handlers import Handler

# lifecycle_msgs: the labels that every lifecycle node of ROS 2 has.
_STATES: Final = (
    *STATES,
    *("configuring", "cleaningup", "activating", "deactivating", "shuttingdown", "errorprocessing"),
)
_TRANSITIONS: Final = (
    *("create", "configure", "cleanup", "activate", "deactivate", "destroy"),
    *("unconfigured_shutdown", "inactive_shutdown", "active_shutdown"),
    *(
        f"{kind}_{outcome}"
        for kind in ("on_configure", "on_cleanup", "on_activate", "on_deactivate", "on_shutdown", "on_error")
        for outcome in ("success", "failure", "error")
    ),
    *("transition_success", "transition_failure", "transition_error"),
)
# What people call them: what a node has been told to do is no state, and a number is no label.
_MEANINGS: Final = {
    "activated": "active",
    "enabled": "active",
    "running": "active",
    "started": "active",
    "configured": "inactive",
    "deactivated": "inactive",
    "disabled": "inactive",
    "idle": "inactive",
    "cleaned_up": "unconfigured",
    "cleanedup": "unconfigured",
    "created": "unconfigured",
    "destroyed": "finalized",
    "finished": "finalized",
    "shutdown": "finalized",
    "stopped": "finalized",
    "error": "errorprocessing",
    "start": "activate",
    "stop": "deactivate",
    "init": "configure",
}
_STATES_BY_NUMBER: Final = dict(enumerate(("unconfigured", "inactive", "active", "finalized"), 1))
_TRANSITIONS_BY_NUMBER: Final = dict(enumerate(("configure", "cleanup", "activate", "deactivate"), 1))


class OnStateTransition(EventHandler):
    """Wait for transitions of a node, None: of any; narrowed by labels, which are compared as they are.

    A `matcher` stands for all of these. Raises `RuntimeError` for a target that is no `LifecycleNode`.
    """

    def __init__(
        self,
        *,
        entities: Any,
        target_lifecycle_node: Any = None,
        transition: Any = None,
        start_state: Any = None,
        goal_state: Any = None,
        matcher: Callable[[Any], bool] | None = None,
        **kwargs: Any,
    ) -> None:
        if target_lifecycle_node is not None and not isinstance(target_lifecycle_node, LifecycleNode):
            told = f"OnStateTransition waits for a LifecycleNode, not for {target_lifecycle_node!r}"
            raise WrongRuntime(told, path=("target_lifecycle_node",))
        self.__is_custom = matcher is not None
        self.__target = target_lifecycle_node
        self.__labels = {
            "transition": _label("transition", transition, _TRANSITIONS),
            "start_state": _label("start_state", start_state, _STATES),
            "goal_state": _label("goal_state", goal_state, _STATES),
        }
        super().__init__(
            matcher=matcher if matcher is not None else self.__matches, entities=entities, **kwargs
        )

    @property
    def handler_description(self) -> str:
        """What is done."""
        return "<actions>"

    @property
    def matcher_description(self) -> str:
        """Which events are meant."""
        kind = "event == StateTransition"
        return kind if self.__target is None else f"{kind} and event.action == LifecycleNode"

    def __matches(self, event: Any) -> bool:
        if not isinstance(event, StateTransition):
            return False
        if self.__target is not None and event.action is not self.__target:
            return False
        return all(label is None or getattr(event, name) == label for name, label in self.__labels.items())

    def _to_models(self) -> tuple[Handler, ...]:
        if self.__is_custom or not is_of_ours(self, "matches"):
            return super()._to_models()
        if not is_of_ours(self, "handle"):
            done: dict[str, Any] = {"callback": self.handle}
        else:
            done = {"children": models_of(entities_of(self.entities), self._place)}
        return (self._model("state_changed", target=self.__target, **done, **self.__labels),)


def _meant(label: str, known: tuple[str, ...]) -> str | None:
    """Return the label that was meant by another word, or by a slip."""
    word = _MEANINGS.get(label.lower().replace("-", "_").replace(" ", "_"))
    return word if word in known else nearest(label, known)


def _label(name: str, written: Any, known: tuple[str, ...]) -> str | None:
    """Return the label of a transition or state. Upstream compares it as it is, so that only a text ever matches.

    Raises `TypeError` for anything else, and for what is nearly one of those that there are.
    """
    label = written.text if isinstance(written, TextSubstitution) else written
    if label is not None and not isinstance(label, str):
        of_number = (_TRANSITIONS_BY_NUMBER if known is _TRANSITIONS else _STATES_BY_NUMBER).get(label)
        instead = None if of_number is None else Rewritten(repr(of_number))
        message = f"the label of a transition or state is a text, not {written!r}"
        raise WrongType(message, path=(name,), suggestion=instead)
    meant = None if label is None or label in known else _meant(label, known)
    if meant is not None:
        told = f"lifecycle nodes have no {name.replace('_', ' ')} {label!r}"
        raise WrongType(told, path=(name,), code=Code.BAD_VALUE, suggestion=meant)
    return label

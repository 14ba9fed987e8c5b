"""`OnStateTransition`: what is done when a lifecycle node makes a transition."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.building import models_of
from orchestra.compat.launch.event_handler import EventHandler, entities_of, is_of_ours
from orchestra.compat.launch.substitutions.text_substitution import TextSubstitution
from orchestra.compat.launch_ros.actions.lifecycle_node import LifecycleNode
from orchestra.compat.launch_ros.events.lifecycle.state_transition import StateTransition

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestra.description.handlers import Handler


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
            raise RuntimeError(
                f"OnStateTransition waits for a LifecycleNode, not for {target_lifecycle_node!r}"
            )
        self.__is_custom = matcher is not None
        self.__target = target_lifecycle_node
        self.__labels = {
            "transition": _label(transition),
            "start_state": _label(start_state),
            "goal_state": _label(goal_state),
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


def _label(written: Any) -> str | None:
    """Return the label of a transition or state. Upstream compares it as it is, so that only a text ever matches."""
    if written is None or isinstance(written, str):
        return written
    if isinstance(written, TextSubstitution):
        return written.text
    raise TypeError(f"the label of a transition or state is a text, not {written!r}")

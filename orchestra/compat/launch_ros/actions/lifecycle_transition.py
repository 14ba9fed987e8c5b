"""`LifecycleTransition`: takes lifecycle nodes through transitions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import ModelledAction
from orchestra.compat.text import normalized, template
from orchestra.compat.values import written
from orchestra.compat.wrong import WrongNumber
from orchestra.description.actions.lifecycle_transition import LifecycleTransition as LifecycleTransitionModel

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from orchestra.compat.text import Sub
    from orchestra.description.entity import Action as Model


class LifecycleTransition(ModelledAction):
    """Take each of the nodes through the transitions, in order, each when the one before has reached its goal.

    Names are full names, the slash in front may be left out; ids are those of lifecycle_msgs. Raises `ValueError`
    where either list is empty.
    """

    def __init__(
        self, *, lifecycle_node_names: Sequence[Sub], transition_ids: Sequence[int | Sub], **kwargs: Any
    ) -> None:
        super().__init__(**kwargs)
        if not lifecycle_node_names:
            raise WrongNumber(
                "LifecycleTransition names no node in lifecycle_node_names", path=("lifecycle_node_names",)
            )
        if not transition_ids:
            raise WrongNumber(
                "LifecycleTransition names no transition in transition_ids", path=("transition_ids",)
            )
        self.__lifecycle_node_names = [normalized(name) for name in lifecycle_node_names]
        self.__transition_ids = [normalized(written(transition)) for transition in transition_ids]

    def _to_model(self, common: Mapping[str, Any]) -> Model:
        names, ids = self._place.at("lifecycle_node_names"), self._place.at("transition_ids")
        listed = enumerate(self.__lifecycle_node_names), enumerate(self.__transition_ids)
        return LifecycleTransitionModel.at(
            self._place.span,
            node=tuple(template(name, names.inside(index)) for index, name in listed[0]),
            transition=tuple(template(transition, ids.inside(index)) for index, transition in listed[1]),
            **common,
        )

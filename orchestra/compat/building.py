"""Models from compat objects."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.action import Action, ModelledAction
from orchestra.compat.place import Place, here

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
    from orchestra.description.entity import Action as Model


def model_of(entity: LaunchDescriptionEntity) -> Model:
    """Return the model of a Python entity, its condition included; an opaque one where only its code knows more."""
    from orchestra.description.actions.opaque import OpaqueAction  # noqa: PLC0415 - pydantic, only where files are read

    if isinstance(entity, ModelledAction) and entity._is_as_described():
        return entity._to_model(conditioned(entity))
    place: Place = getattr(entity, "_place", None) or here()
    if isinstance(entity, Action) and type(entity).visit is Action.visit:
        return OpaqueAction.at(place.span, target=entity, **conditioned(entity))
    return OpaqueAction.at(place.span, target=entity, origin=entity)


class Described(ModelledAction):
    """An action of a launch file in YAML or XML, as an entity of Python."""

    def __init__(self, model: Model) -> None:
        super().__init__()
        self._model = model

    def _to_model(self, common: Mapping[str, Any]) -> Model:  # noqa: ARG002 - the model says it all
        return self._model


def models_of(entities: Iterable[LaunchDescriptionEntity]) -> tuple[Model, ...]:
    """Return the models of several entities. One that has none stays opaque: the visit tells why, at its own place."""
    return tuple(_model_or_opaque(entity) for entity in entities)


def _model_or_opaque(entity: LaunchDescriptionEntity) -> Model:
    try:
        return model_of(entity)
    except ValueError:  # pydantic's ValidationError is one
        from orchestra.description.actions.opaque import OpaqueAction  # noqa: PLC0415 - as above

        place: Place = getattr(entity, "_place", None) or here()
        return OpaqueAction.at(place.span, target=entity, origin=entity)


def conditioned(action: Action) -> dict[str, Any]:
    """Return the fields that every model of an action has."""
    if action.condition is None:
        return {"origin": action}
    return {"origin": action, **action.condition._fields(action._place.span)}

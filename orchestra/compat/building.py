"""Models from compat objects."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.explanation import told
from orchestra.compat.launch.action import Action, ModelledAction
from orchestra.compat.launch.condition import Condition
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.place import Arguments, Place, here
from orchestra.compat.wrong import WrongType

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.description.entity import Action as Model
    from orchestra.location import Span


def model_of(entity: LaunchDescriptionEntity) -> Model:
    """Return the model of a Python entity, its condition included; an opaque one where only its code knows more."""
    plain = entity._plain_model()
    if plain is not None:
        return plain
    if isinstance(entity, ModelledAction) and entity._is_as_described():
        model = entity._to_model(conditioned(entity))
        if entity._refused:
            model.mark_faulty()
        return model
    from orchestra.description.actions.opaque import OpaqueAction  # noqa: PLC0415 - pydantic, only where files are read

    place: Place | None = getattr(entity, "_place", None)
    if isinstance(entity, Action) and type(entity).visit is Action.visit:
        if place is None:
            raise TypeError(f"{type(entity).__name__}.__init__ does not call super().__init__()")
        return made_of(OpaqueAction, place, {"target": entity}, conditioned(entity))
    return OpaqueAction.made((place or here()).span, {"target": entity}, entity)


class Described(ModelledAction):
    """An action of a launch file in YAML or XML, as an entity of Python."""

    def __init__(self, model: Model) -> None:
        super().__init__()
        self._model = model

    def _to_model(self, common: Mapping[str, Any]) -> Model:  # noqa: ARG002 - the model says it all
        return self._model


def models_of(entities: Iterable[Any], place: Place, argument: str = "actions") -> tuple[Model, ...]:
    """Return the models of the entities that stand at a place, as an argument of the call there.

    One that has none stays opaque: the visit tells why, at its own place. Raises `TypeError` for what is no iterable.
    """
    if not isinstance(entities, Iterable):
        told_so = f"a list of actions is expected here, this is {told(entities)}"
        raise WrongType(told_so, entities, at=place.at(argument))
    return models_in(list(entities), Arguments(place))


def models_in(entities: list[Any], call: Arguments) -> tuple[Model, ...]:
    """Return the same of a list that an argument of a call holds."""
    return tuple([_model_or_opaque(entity, index, entities, call) for index, entity in enumerate(entities)])


def _model_or_opaque(entity: Any, index: int, entities: list[Any], call: Arguments) -> Model:
    if isinstance(entity, LaunchDescriptionEntity):
        try:
            return model_of(entity)
        except Exception:  # noqa: BLE001 - the visit of the entity alone comes upon the same
            at: Place = getattr(entity, "_place", None) or call.place
            span = at.span
    else:
        # Here, because only mistakes need it, and what it imports.
        from orchestra.compat.literals import item_span  # noqa: PLC0415

        span = item_span(call.place, index, len(entities))
    from orchestra.description.actions.opaque import OpaqueAction  # noqa: PLC0415 - as above

    return OpaqueAction.made(span, {"target": entity}, entity)


def conditioned(action: Action) -> dict[str, Any]:
    """Return the fields that every model of an action has. Raises `TypeError` for what is no condition."""
    if action.condition is None:
        return {"origin": action}
    return {"origin": action, **condition_fields(action.condition, action._place.at("condition"))}


def made_of(kind: type[Model], place: Place, fields: dict[str, Any], common: Mapping[str, Any]) -> Model:
    """Return the model of an action at a place, whose own fields nothing can be wrong with, by their names in models.

    `common` are the fields that every action has. Raises `ValidationError` for a condition of other words.
    """
    condition = unchecked(common)
    if condition is None:
        return kind.at(place.span, **fields, **common)
    return kind.made(place.span, {**fields, **condition}, common["origin"])


def unchecked(common: Mapping[str, Any]) -> dict[str, Any] | None:
    """Return the condition among the fields that every action has, by its name in models; none where there is none.

    None where it is for the validator to look at its words.
    """
    if len(common) == 1:
        return {}
    ((word, condition),) = [(name, value) for name, value in common.items() if name != "origin"]
    return {_CONDITIONS[word]: condition} if condition.constant is None else None


_CONDITIONS: Final = {"if": "if_", "unless": "unless"}


def condition_fields(condition: Any, span: Span) -> dict[str, Any]:
    """Return the field of a model for a condition. Raises `TypeError` for what is none."""
    if isinstance(condition, Condition):
        return condition._fields(span)
    is_object = not isinstance(condition, type)
    if is_object and callable(getattr(condition, "evaluate", None)):  # it derives from nothing, as upstream
        return Condition(predicate=condition.evaluate)._fields(span)
    told_so = f"a condition is made by IfCondition or UnlessCondition, this is {told(condition)}"
    raise WrongType(told_so, condition, at=span)

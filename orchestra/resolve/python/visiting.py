"""Visits entities of Python launch files, in upstream's order: depth-first, what an entity returns right after it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.compat.building import model_of
from orchestra.compat.explanation import told
from orchestra.compat.launch.action import Action, ModelledAction
from orchestra.compat.launch.launch_description import LaunchDescription
from orchestra.compat.launch.launch_description_entity import LaunchDescriptionEntity
from orchestra.compat.place import Argument
from orchestra.compat.refusing import is_lost
from orchestra.compat.wrong import WrongType
from orchestra.description.core import ValidationError
from orchestra.errors import Code
from orchestra.location import displayed, point
from orchestra.resolve.context import POISON
from orchestra.resolve.python.calling import stepped, user_code

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.compat.launch.actions.opaque_function import OpaqueFunction
    from orchestra.compat.place import Place
    from orchestra.description.actions.opaque import OpaqueAction
    from orchestra.description.entity import Action as Model
    from orchestra.location import Span
    from orchestra.resolve.resolution import Resolution


def visit_entities(entities: Iterable[Any], run: Resolution, place: Place | None = None) -> None:
    """Visit entities in order, which stand at a place. An iterable that grows is followed to its end, as upstream."""
    run.visit(_models(entities, run, place), run)


def visit_entity(entity: Any, run: Resolution, place: Place | None = None) -> None:
    """Visit an entity, by its model where it has one; `place` is that of what holds it."""
    visit_entities((entity,), run, place)


def _models(entities: Iterable[Any], run: Resolution, place: Place | None) -> Iterator[Model]:
    """Yield the models of entities, each when it is visited. What has none is dealt with on the way."""
    for index, entity in enumerate(entities):
        if isinstance(entity, LaunchDescriptionEntity):
            model = _model(entity, run, place)
            if model is not None:
                yield model
        else:
            # Here and below, because only mistakes need it, and what it imports.
            from orchestra.compat.literals import item_span  # noqa: PLC0415

            count = len(entities) if isinstance(entities, list | tuple) else 0
            span = _span(entity, run) if place is None else item_span(place, index, count)
            _refuse_other(entity, span, run, is_written=place is None or span != place.span)


def _model(entity: Any, run: Resolution, place: Place | None) -> Model | None:
    """Return the model of an entity; of one without, what it holds is visited."""
    if entity._lost is not None:
        run.scope.ledger.incomplete = True
        name = vars(entity).get("_lost_name")
        if isinstance(name, str):  # what reads it is not to be told of it
            run.found.lost.add(name)
        visit_entities(entity._lost, run)
        return None
    try:
        return model_of(entity)
    except ValidationError as error:
        _refuse(entity, error, run)
        visit_entities(_children(entity), run)
    except Exception as error:  # what users have given it is only looked at here
        if isinstance(error, RecursionError) and run.is_deep:
            raise
        from orchestra.compat import faults  # noqa: PLC0415 - as above

        faults.report(error, run.problems, run.context.included_from, _span(entity, run, place))
        run.scope.ledger.incomplete = True
        if entity._role == "declaration":  # what reads it is not to be told of it
            run.scope.set(entity.name, POISON, run.at(_span(entity, run, place)))
    return None


def _children(entity: Any) -> list[Any]:
    """Return the entities that an action of ours holds: what is wrong with them is told without it."""
    if entity._role == "include":  # a file has a scope of its own
        return []
    held = [entity.describe_sub_entities(), *(held for _, held in entity.describe_conditional_sub_entities())]
    return [child for children in held for child in children if _is_entity(child)]


def visit_opaque(action: OpaqueAction, run: Resolution) -> None:
    """Visit an entity that only its own code can carry out; its condition, where it has one, holds."""
    entity = action.target
    if not _is_entity(entity):
        from orchestra.compat.misplaced import is_list_at  # noqa: PLC0415 - as above

        is_list = isinstance(entity, list | tuple)
        _refuse_other(entity, action.span, run, is_written=is_list and is_list_at(action.span))
        return
    if is_lost(entity) or (isinstance(entity, ModelledAction) and entity._is_as_described()):
        visit_entity(entity, run)  # which it has no sound model for
        return
    if entity._refused:  # its code would miss what was wrong
        run.scope.ledger.incomplete = True
        return
    if isinstance(entity, LaunchDescription) and entity.deprecated:
        message = f"{displayed(run.context.file or '')} is deprecated: {entity.deprecated_reason}"
        run.problems.warning(Code.DEPRECATED, message, run.at(action.span))
    if type(entity).visit is LaunchDescription.visit:
        if not entity.entities and entity._lacks_entities:
            _warn_of_none(entity, run)
        visit_entities(entity.entities, run, getattr(entity, "_place", None))
        return
    if run.later:
        from orchestra.resolve.python.deferral import Deferred, put_off  # noqa: PLC0415 - few wait for something

        put_off(Deferred("entity", entity), run.at(action.span), run)
        return
    _carry_out(entity, action.span, run)


def _warn_of_none(description: LaunchDescription, run: Resolution) -> None:
    """Warn of a launch description that is given None: code that does so has lost its actions."""
    from orchestra.compat.literals import call_at, keyword  # noqa: PLC0415 - as above
    from orchestra.compat.rewritten import rewritten  # noqa: PLC0415 - as above

    place = description._place
    call = call_at(place)
    if call is not None and (call.args or call.keywords):
        span = keyword(place, "initial_entities").whole
        message = (
            "a launch description of None has no action: append and extend change a list and return None"
        )
        meant = rewritten(place.file, span, None, message)
        run.problems.warning(Code.WRONG_TYPE, message, run.at(span), suggestion=meant)


def _carry_out(entity: Any, span: Span, run: Resolution) -> None:
    """Run the code of an entity, and visit what it returns."""
    following: Any = None
    context = run.engine.context
    with user_code(run, span):
        made = _executed(entity, context, span, run)
        if made is not None and (isinstance(made, str | Mapping) or not isinstance(made, Iterable)):
            told_so = f"{_name(entity)} returns a list of actions or None, this is {told(made)}"
            raise WrongType(told_so, made, at=_returned(entity, made))
        following = made if isinstance(made, list | tuple) else stepped(made, run, span)
    if following is not None:
        _visit_returned(entity, following, run)
    else:
        from orchestra.compat.launch.actions.opaque_function import OpaqueFunction  # noqa: PLC0415 - many files have none

        if isinstance(entity, OpaqueFunction):
            _tell_thrown_away(entity, run)


def _executed(entity: Any, context: Any, span: Span, run: Resolution) -> Any:
    """Return what the code of an entity returns; what it stops at is told, and what was meant is run instead."""
    judged = isinstance(entity, Action) and type(entity).visit is Action.visit
    while True:
        try:
            return entity.execute(context) if judged else entity.visit(context)
        except TypeError as error:
            at = _uncallable(entity, error)
            if at is not None:
                told_so = f"{_name(entity)} is called with the context: {_short(entity, error)}"
                raise WrongType(told_so, at=at) from None
            fault: Exception = error
        except Exception as error:  # noqa: BLE001 - the boundary of user code
            fault = error
        if isinstance(fault, RecursionError):
            raise fault
        from orchestra.compat.carrying_on import go_on  # noqa: PLC0415 - as above

        go_on(fault, getattr(entity, "function", None), run.problems, run.context.included_from, span)


def _tell_thrown_away(entity: OpaqueFunction, run: Resolution) -> None:
    """Warn of a function that makes actions and returns nothing."""
    from orchestra.compat.thrown_away import without_return  # noqa: PLC0415 - few return nothing

    fault = without_return(entity.function)
    if fault is not None and not fault.is_told(run.problems):
        run.problems.warning(Code.USER_CODE, fault.message, run.at(fault.span), suggestion=fault.suggestion)


def _uncallable(entity: Any, error: TypeError) -> Span | None:
    """Return where the function of an entity stands if it is one that takes no context; None for any other fault."""
    function = getattr(entity, "function", None)
    name = getattr(function, "__qualname__", None)
    refused = name is not None and str(error).startswith(f"{name}() takes")
    if not refused:
        return None
    from orchestra.compat.functions import name_of  # noqa: PLC0415 - as above

    return name_of(function)


def _visit_returned(entity: Any, following: Iterable[Any], run: Resolution) -> None:
    """Visit what code has returned; what is no entity stands where it is returned."""
    if isinstance(following, list | tuple) and not all(map(_is_entity, following)):
        from orchestra.compat.functions import returned_by  # noqa: PLC0415 - as above

        returned = returned_by(getattr(entity, "function", None), following)
        if returned is not None:
            for index, item in enumerate(following):
                if not _is_entity(item):
                    written = returned.item(index, len(following))
                    _refuse_other(item, written.whole, run, is_written=written.node is not None)
            following = [item for item in following if _is_entity(item)]
    visit_entities(following, run, getattr(entity, "_place", None))


def _returned(entity: Any, made: Any) -> Span | None:
    from orchestra.compat.functions import returned_by  # noqa: PLC0415 - as above

    returned = returned_by(getattr(entity, "function", None), made)
    return None if returned is None else returned.whole


def _is_entity(value: Any) -> bool:
    return isinstance(value, LaunchDescriptionEntity)


def _refuse_other(value: Any, span: Span, run: Resolution, *, is_written: bool = False) -> None:
    """Report something that is no entity; `is_written`: it is just that which is written at the place."""
    # Here, because only mistakes need it, and what it imports.
    from orchestra.compat.misplaced import misplaced  # noqa: PLC0415
    from orchestra.compat.rewritten import last_comma, rewritten  # noqa: PLC0415

    message, notes = misplaced(value)
    file = str(Path(span.file).absolute())
    if value is None:
        from orchestra.compat.thrown_away import called_without_return  # noqa: PLC0415 - as above

        fault = called_without_return(file, span)
        if fault is not None:
            run.problems.error(
                Code.WRONG_TYPE, fault.message, run.at(fault.span), suggestion=fault.suggestion
            )
            return
    meant = rewritten(file, span, value, message) if is_written else None
    comma = last_comma(file, span) if isinstance(value, tuple) and len(value) == 1 and is_written else None
    if comma is not None:
        span, meant, notes = comma, None, ("the comma at its end makes a tuple of it",)
    run.problems.error(Code.WRONG_TYPE, message, run.at(span), suggestion=meant, notes=notes)
    if isinstance(value, list | tuple):  # what is in it is not to be missed as well
        visit_entities([item for item in value if _is_entity(item)], run)


def _refuse(entity: Any, error: ValidationError, run: Resolution) -> None:
    """Report values that an action of Python cannot have, each where it stands."""
    for detail in error.errors(include_url=False):
        place = ".".join(str(step) for step in detail["loc"])
        span = getattr(detail["input"], "span", None)
        if isinstance(span, Argument):
            place = str(span.path[0])
        told_so = f"{_name(entity)}: {place}: {detail['msg']}"
        at = run.at(span if isinstance(span, Argument) else _span(entity, run))
        suggestion = detail.get("ctx", {}).get("suggestion")
        if suggestion is None and isinstance(span, Argument):
            suggestion = _variable(getattr(detail["input"], "constant", None), span.place.file, run)
        run.problems.error(Code.WRONG_TYPE, told_so, at, suggestion=suggestion)


def _variable(text: str | None, file: str, run: Resolution) -> str | None:
    """Return the argument whose name was written in place of its value."""
    # Here, because only mistakes need it, and what it imports.
    from orchestra.compat.rewritten import Rewritten  # noqa: PLC0415
    from orchestra.compat.syntax_trees import tree_of  # noqa: PLC0415

    tree = tree_of(file)
    declared = text in run.scope.variables or (tree is not None and text in tree.declared())
    return Rewritten(f"LaunchConfiguration({text!r})") if declared else None


def _name(entity: Any) -> str:
    function = getattr(entity, "function", None)
    return f"{getattr(function, '__name__', '') or type(entity).__name__}"


def _short(entity: Any, error: TypeError) -> str:
    """Return what Python says of a call, without the functions around the one that is called."""
    function = entity.function
    return str(error).replace(function.__qualname__, function.__name__, 1)


def _span(entity: Any, run: Resolution, around: Place | None = None) -> Span:
    own = getattr(entity, "__dict__", {})
    place: Place | None = entity._place if "_made_at" in own else own.get("_place", around)
    return place.span if place is not None else point(displayed(run.context.file or ""))

"""Every key of every action has a form in XML."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.description.actions import ACTIONS, model_of
from orchestra.description.actions.arg import Arg
from orchestra.description.actions.group import Group
from orchestra.description.actions.node import Node
from orchestra.description.conditions import ParameterFact, Ready, TransformFact
from orchestra.description.entity import Entity
from orchestra.description.launch import Launch
from orchestra.description.limits import Limits, Rlimits
from orchestra.description.parts import Param, Restart
from orchestra.load.forms import Form, Kind, forms_of

if TYPE_CHECKING:
    from collections.abc import Iterator


def _models(model: type[Entity], seen: set[type[Entity]]) -> Iterator[type[Entity]]:
    """Yield a model and those of its parts, however deep."""
    if model in seen:
        return
    seen.add(model)
    yield model
    for form in forms_of(model).by_key.values():
        if form.model is not None:
            yield from _models(form.model, seen)


@pytest.mark.parametrize("name", sorted(ACTIONS))
def test_every_key_of_an_action_and_of_its_parts_has_a_form(name: str) -> None:
    model = model_of(name)
    assert model is not None
    for part in _models(model, set()):
        forms = forms_of(part)
        assert forms.by_key.keys() == part.known_keys()
        assert forms.holds_actions == ("children" in forms.by_key)


@pytest.mark.parametrize(
    ("model", "key", "form"),
    [
        (Node, "exec", Form(Kind.TEXT)),
        (Node, "if", Form(Kind.TEXT)),
        (Node, "respawn_delay", Form(Kind.TEXT)),
        (Node, "output", Form(Kind.TEXT, or_variables=True)),
        (Node, "success_exit_codes", Form(Kind.LIST)),
        (Node, "param", Form(Kind.PARTS, Param)),
        (Node, "ready", Form(Kind.PART, Ready)),
        (Node, "restart", Form(Kind.PART, Restart, or_text=True)),
        (Ready, "parameter", Form(Kind.PART, ParameterFact, or_text=True)),
        (Ready, "tf", Form(Kind.PART, TransformFact)),
        (Ready, "command", Form(Kind.TEXT)),
        (Limits, "cores", Form(Kind.TEXT)),
        (Limits, "rlimits", Form(Kind.PART, Rlimits)),
        (Param, "value", Form(Kind.TEXT)),
        (Param, "param", Form(Kind.PARTS, Param)),
        (Arg, "choices", Form(Kind.LIST)),
        (Group, "for_each", Form(Kind.VARIABLES)),
        (Group, "children", Form(Kind.ACTIONS)),
        (Launch, "deprecated", Form(Kind.TEXT)),
    ],
)
def test_the_type_of_a_field_tells_its_form(model: type[Entity], key: str, form: Form) -> None:
    assert forms_of(model).by_key[key] == form


def test_a_type_that_nobody_has_thought_of_is_refused() -> None:
    class Strange(Entity):
        key: bytes

    with pytest.raises(TypeError, match="has no form in XML"):
        forms_of(Strange)

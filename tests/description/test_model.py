"""Objects of models cannot be changed; others are made of them."""

from __future__ import annotations

import pytest

from orchestra.description.actions.let import Let
from orchestra.description.actions.node import Node
from orchestra.description.actions.node_container import NodeContainer
from orchestra.description.core import ValidationError
from orchestra.description.parts import Remap
from orchestra.description.text import Template, Words
from orchestra.location import point

_AT = point("a.yaml")


def _text(text: str) -> Template:
    return Template((Words(text, _AT),), text, _AT)


def _let(name: str) -> Let:
    return Let.at(_AT, name=_text(name), value=_text("b"))


def test_a_field_cannot_be_set_or_deleted() -> None:
    action = _let("a")
    with pytest.raises(AttributeError, match="cannot assign to field 'name' of Let"):
        action.name = _text("b")  # type: ignore[misc]
    with pytest.raises(AttributeError, match="cannot delete field 'name' of Let"):
        del action.name
    assert action.name == _text("a")


def test_what_is_equal_says_the_same_at_the_same_place() -> None:
    assert _let("a") == _let("a")
    assert hash(_let("a")) == hash(_let("a"))
    assert _let("a") != _let("b")
    assert _let("a") != Let.at(point("b.yaml"), name=_text("a"), value=_text("b"))
    assert _let("a") != "a"


def test_a_copy_has_other_values_and_a_state_of_its_own() -> None:
    action = _let("a")
    copy = action.model_copy(update={"name": _text("c")})
    assert (copy.name, copy.value, copy.span) == (_text("c"), action.value, action.span)
    copy.mark_faulty()
    assert copy.faulty
    assert not action.faulty
    assert action.name == _text("a")


def test_fields_are_known_by_alias_and_by_name() -> None:
    by_alias = Remap.model_validate({"from": _text("a"), "to": _text("b")})
    by_name = {"from_": _text("a"), "to": _text("b")}
    assert by_alias == Remap.model_validate(by_name) == Remap(**by_name)
    with pytest.raises(ValidationError, match="beside"):
        Remap.model_validate({"from": _text("a"), "to": _text("b"), "beside": _text("c")})


def test_a_field_that_is_declared_anew_keeps_its_place() -> None:
    fields = list(NodeContainer.model_fields)
    assert fields[-1] == "composable_node"
    assert [name for name in Node.model_fields if name in fields] == fields[:-1]
    assert set(Node.model_fields) - set(fields) == {"module", "script"}
    assert NodeContainer.model_fields["name"].is_required()
    assert not Node.model_fields["name"].is_required()


def test_an_object_shows_what_it_holds() -> None:
    assert repr(_let("a")).startswith("Let(if_=None, unless=None, name=Template(")

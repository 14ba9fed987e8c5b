"""Every action has a model, a visitor and an entry in the schema, and reads the same keys everywhere."""

from __future__ import annotations

import importlib
import pkgutil
from typing import TYPE_CHECKING

import pytest

from orchestra.description import actions
from orchestra.description.actions import ACTIONS, model_of
from orchestra.description.actions.let import Let
from orchestra.description.conditions import Ready
from orchestra.description.core import ValidationError
from orchestra.description.entity import Action, Entity
from orchestra.description.fields import FALSE_WORDS, TRUE_WORDS
from orchestra.description.parts import Param
from orchestra.description.schema import launch_schema
from orchestra.description.substitutions import SIGNATURES
from orchestra.description.text import Call, Template, Words
from orchestra.location import point
from orchestra.resolve.booleans import boolean
from orchestra.resolve.interpret import VISITORS
from orchestra.resolve.substitutions.table import SUBSTITUTIONS

if TYPE_CHECKING:
    from collections.abc import Iterator


def _text(text: str) -> Template:
    at = point("a.yaml")
    return Template((Words(text, at),), text, at)


_MODULES = {"for": "for_loop"}  # what a module cannot be called


@pytest.mark.parametrize("name", ACTIONS)
def test_an_action_is_modelled_visited_and_in_the_schema(name: str) -> None:
    model = model_of(name)
    assert model is not None
    assert issubclass(model, Action)
    assert VISITORS[model.__name__] == _MODULES.get(name, name)
    assert model.__doc__
    schema = launch_schema()["$defs"]
    assert set(schema[name]["properties"]) == model.known_keys()
    assert set(schema[name].get("required", ())) == model.required_beside(model.known_keys())


def test_there_is_nothing_else_to_visit() -> None:
    """Every other model is one that only Python launch files make."""
    for module in pkgutil.iter_modules(actions.__path__, f"{actions.__name__}."):
        importlib.import_module(module.name)
    models = {model.__name__ for model in map(model_of, ACTIONS) if model is not None}
    others = {model.__name__ for model in _entities(Action)} - models - {"Running"}
    assert models | others == set(VISITORS)
    assert all(
        importlib.import_module(f"orchestra.resolve.actions.{name}").visit for name in VISITORS.values()
    )
    assert model_of("nothing") is None


def test_every_substitution_that_can_be_read_can_be_performed() -> None:
    assert set(SIGNATURES) == set(SUBSTITUTIONS)


def test_what_is_read_as_a_flag_is_one_when_it_is_evaluated() -> None:
    assert {word for word in TRUE_WORDS if boolean(word) is True} == TRUE_WORDS
    assert {word for word in FALSE_WORDS if boolean(word) is False} == FALSE_WORDS


def _entities(of: type[Entity] = Entity) -> Iterator[type[Entity]]:
    for model in of.__subclasses__():
        yield model
        yield from _entities(model)


def test_every_key_is_a_word_that_xml_can_have_too() -> None:
    keys = {key for model in _entities() for key in model.known_keys()}
    assert {key for key in keys if not key.replace("_", "").isalpha() or key != key.lower()} == set()


def test_models_are_made_by_programs_too() -> None:
    action = Let(name=_text("a"), value=_text("b"))
    assert action.name.constant == "a"
    assert not action.faulty
    assert not Param.model_validate({"name": _text("a"), "value": _text("1")}).faulty


@pytest.mark.parametrize(
    ("model", "values"),
    [
        (Param, {"name": _text("a"), "value": _text("1"), "from": _text("b")}),
        (Param, {"name": _text("a")}),
        (Ready, {}),
        (Let, {"name": _text("a"), "value": _text("b"), "if": _text("true"), "unless": _text("true")}),
    ],
)
def test_keys_that_cannot_stand_together_are_refused_from_programs_too(
    model: type[Entity], values: dict[str, Template]
) -> None:
    with pytest.raises(ValidationError):
        model.model_validate(values)


def test_texts_of_a_file_need_a_reader() -> None:
    with pytest.raises(TypeError, match="loader"):
        Let.model_validate({"name": "a", "value": "b"})


def test_a_template_is_constant_where_nothing_is_to_be_evaluated() -> None:
    at = point("a.yaml")
    assert _text("a").constant == "a"
    assert Template((), "", at).constant == ""
    assert Template((Call("var", (_text("a"),), at),), "$(var a)", at).constant is None
    assert Template((), "", at, faulty=True).constant is None

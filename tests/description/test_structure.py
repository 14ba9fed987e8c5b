"""What the core is told of the models is what pydantic tells it of the same fields."""

from __future__ import annotations

import importlib
import pkgutil
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.description import actions
from orchestra.description.entity import Action
from orchestra.description.handlers import Handler
from orchestra.description.launch import Launch
from orchestra.description.structure import Schemas, structure_of
from orchestra.description.twins import twin

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.entity import Entity

_ROOTS: set[type[Entity]] = {Launch, Handler}
for _module in pkgutil.iter_modules(actions.__path__, f"{actions.__name__}."):
    importlib.import_module(_module.name)


def _below(of: type[Entity]) -> Iterator[type[Entity]]:
    for model in of.__subclasses__():
        yield model
        yield from _below(model)


# How users write it, and what becomes of it afterwards, is no matter of validation.
_ASIDE = {
    "metadata",
    "serialization",
    "serialization_alias",
    "ref",
    "computed_fields",
    "config",
    "model_name",
}
_ASIDE |= {"custom_init", "root_model"}


class _Plainly:
    """Schemas without what is no matter of validation, every model in them in full, but once in itself."""

    def __init__(self) -> None:
        self._named: dict[str, Any] = {}
        self._open: list[str] = []

    def of(self, schema: Any) -> Any:
        if isinstance(schema, list):
            return [self.of(item) for item in schema]
        if callable(schema):
            return schema.__module__, schema.__qualname__
        if not isinstance(schema, dict):
            return schema
        match schema.get("type"):
            case "definitions":
                self._named |= {item["ref"]: item for item in schema["definitions"]}
                return self.of(schema["schema"])
            case "definition-ref":
                return self._once(self._named[schema["schema_ref"]])
            case "function-wrap":  # reading, which ours have in front of the model
                return self.of(schema["schema"])
            case "model":
                return self._model(schema)
        return {key: self.of(value) for key, value in schema.items() if key not in _ASIDE}

    def _once(self, schema: Any) -> Any:
        inner = schema["schema"] if schema["type"] == "function-wrap" else schema
        return inner["cls"].__name__ if inner["cls"].__name__ in self._open else self.of(inner)

    def _model(self, schema: Any) -> Any:
        name = schema["cls"].__name__
        self._open.append(name)
        fields = self.of(schema["schema"]["fields"])
        self._open.pop()
        config = schema["config"]
        return {
            "model": name,
            "fields": list(fields.items()),  # in the order in which faults are told
            "other keys": config["extra_fields_behavior"],
            "by name": config.get("validate_by_name", config.get("populate_by_name")),  # the older word
        }


@pytest.mark.parametrize("model", sorted(_ROOTS.union(_below(Action)), key=str))
def test_pydantic_makes_the_same_of_a_model(model: type[Entity]) -> None:
    theirs = twin(model)
    theirs.model_rebuild(force=True)
    plain = _Plainly().of(structure_of(model))
    assert plain == _Plainly().of(theirs.__pydantic_core_schema__)
    assert [name for name, _ in plain["fields"]] == list(model.model_fields)


def test_a_type_that_nobody_has_thought_of_is_told() -> None:
    with pytest.raises(KeyError, match="complex"):
        Schemas().of(tuple[complex, ...])
    with pytest.raises(KeyError, match="frozenset"):
        Schemas().of(frozenset[str])

"""pydantic's own models of ours: it makes JSON Schemas, and tests hold the schemas of `structure.py` to its own."""

from __future__ import annotations

from functools import cache, reduce
from operator import or_
from types import UnionType
from typing import TYPE_CHECKING, Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel, ConfigDict, create_model
from pydantic import Field as Declared

from orchestra.dataclass import dataclass
from orchestra.description.marks import Instance
from orchestra.description.model import Model
from orchestra.description.plugins import keep_away

if TYPE_CHECKING:
    from pydantic import GetCoreSchemaHandler
    from pydantic_core import CoreSchema

    from orchestra.description.model import Field

keep_away()

_CONFIG = ConfigDict(
    frozen=True, extra="forbid", arbitrary_types_allowed=True, populate_by_name=True, defer_build=True
)


@dataclass(frozen=True, slots=True)
class _Twin:
    """Lets pydantic see its own model where one of ours is annotated."""

    model: type[Model]

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:  # noqa: ANN401 - pydantic's own signature
        """Return the schema of that model."""
        del source
        return handler.generate_schema(twin(self.model))


@cache
def twin(model: type[Model]) -> type[BaseModel]:
    """Return the model of pydantic that has the fields and the texts of one of ours."""
    fields: dict[str, Any] = {name: _declared(item) for name, item in model.model_fields.items()}
    return create_model(
        model.__name__, __config__=_CONFIG, __doc__=model.__doc__, __module__=model.__module__, **fields
    )


def _declared(item: Field) -> tuple[Any, Any]:
    options: dict[str, Any] = {"alias": item.alias, "description": item.description}
    if not item.is_required():
        options["default"] = item.default
    return _seen(item.annotation), Declared(**options)


def _seen(annotation: Any) -> Any:  # noqa: ANN401 - a type
    """Return a type with pydantic's models in place of ours."""
    origin = get_origin(annotation)
    if isinstance(annotation, type) and issubclass(annotation, Model):
        return Annotated[Any, _Twin(annotation)]
    if origin is Annotated:
        source, *marks = get_args(annotation)
        seen = source if any(isinstance(mark, Instance) for mark in marks) else _seen(source)
        return Annotated[seen, *marks]
    if origin in (Union, UnionType):
        return reduce(or_, map(_seen, get_args(annotation)))
    if origin in (tuple, dict):
        return origin[tuple(map(_seen, get_args(annotation)))]
    return annotation

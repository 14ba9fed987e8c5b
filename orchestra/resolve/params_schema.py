"""What a node names as the declaration of its parameters: a file beside the launch file, or a pydantic model."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.patterns import pattern
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.model import NamedSchema
from orchestra.resolve.paths import beside, existing_file

if TYPE_CHECKING:
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution

_WORD = r"[^\W\d]\w*"
_MODEL = pattern(rf"(?P<module>{_WORD}(?:\.{_WORD})*):(?P<name>{_WORD}(?:\.{_WORD})*)")
_DOTTED = pattern(rf"(?P<module>{_WORD}(?:\.{_WORD})*)\.(?P<name>[A-Z]\w*)")


def params_schema(written: Template | None, run: Resolution) -> NamedSchema | Poison | None:
    """Return what the text names; what is not there is reported.

    `module:Class` is a model, and so is `package.module.Class` where there is no such file.
    """
    value = run.evaluate(written)
    if written is None or not isinstance(value, Value):
        return POISON if isinstance(value, Poison) else None
    model = _MODEL.fullmatch(value.text) or _DOTTED.fullmatch(value.text)
    if model is not None and beside(run.context.file, value.text) is None:
        # Here, because hardly any description names one, and for what it imports.
        from orchestra.resolve.python.models import named_class  # noqa: PLC0415

        found = named_class(model["module"], model["name"], value, written, run)
        return POISON if found is None else NamedSchema(value.text, value.location, model=found)
    path = existing_file(value, written, "parameter schema", run)
    return POISON if path is None else NamedSchema(value.text, value.location, path=path)

"""JSON Schemas: those that a table of parameters can hold are read plainly, others by the library."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.declared.judging import DeclaredParameters
from orchestra.declared.plain_schema import read_plain

if TYPE_CHECKING:
    from orchestra.declared.documents import Document
    from orchestra.declared.model import ParameterSchema
    from orchestra.errors import Problems


def read_schema(document: Document, problems: Problems) -> ParameterSchema | None:
    """Return what a schema says of parameters, None where it is none (which is reported)."""
    plain = read_plain(document.data)
    if plain is not None:
        return DeclaredParameters(plain)
    # Here, because few schemas need it, and for what it imports.
    from orchestra.declared.validated_schema import read_validated  # noqa: PLC0415

    return read_validated(document, problems)

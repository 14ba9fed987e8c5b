"""The schema that a package has for what it starts, where it certainly is one."""

from __future__ import annotations

from orchestra.declared.convention import SCHEMAS, definition_beside, names_of_class, schema_beside
from orchestra.declared.kinds import is_definition
from orchestra.errors import Problems
from orchestra.witness.once import once


def schema_of_package(share: str, called: str, endings: frozenset[str] | None) -> str | None:
    """Return the path of the schema for an executable, or for a class `pkg::Class`, of a package.

    `endings` are those of the files that it may be, as `endings_beside` tells them.
    """
    if endings is not None and endings.isdisjoint(SCHEMAS):
        return None
    return once(("schema", share, called), lambda: _schema(share, called))


def _schema(share: str, called: str) -> str | None:
    names = names_of_class(called) if "::" in called else (called,)
    found = schema_beside(share, names)
    if found is not None:
        return found
    path = definition_beside(share, names)
    if path is None:
        return None
    from orchestra.declared.documents import read_document  # noqa: PLC0415 - few packages have such files

    document = read_document(path, None, Problems())
    return path if document is not None and is_definition(document.data) else None

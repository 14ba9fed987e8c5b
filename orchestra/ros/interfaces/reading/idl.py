"""Definitions in IDL, as rosidl_parser reads them."""

from __future__ import annotations

from typing import Any

from rosidl_parser import definition, parser

from orchestra.ros.interfaces.reading.mistakes import DefinitionError, Place


def content(source: str, package: str, kind: str, file: str) -> Any:  # noqa: ANN401 - a class of rosidl_parser
    """Return the one message, service or action of a file. Raises `DefinitionError`."""
    try:
        found = parser.parse_idl_string(source)
    except (
        Exception
    ) as error:  # the parser of grammars has errors of its own, and asserts what it does not support
        raise DefinitionError(_first_line(error), file, _place(error)) from error
    for of_kind in (definition.Action, definition.Service, definition.Message):
        for element in found.get_elements_of_type(of_kind):
            _check_names(_name(element), package, kind, file)
            return element
    raise DefinitionError("there is no message, service or action in it", file)


def _name(element: Any) -> Any:  # noqa: ANN401 - as above
    return element.structure.namespaced_type if hasattr(element, "structure") else element.namespaced_type


def _check_names(name: Any, package: str, kind: str, file: str) -> None:  # noqa: ANN401 - as above
    if list(name.namespaces) != [package, kind]:
        found = "::".join(name.namespaces)
        raise DefinitionError(f"it defines a type in {found}, not in {package}::{kind}", file)


def _first_line(error: Exception) -> str:
    return next(iter(str(error).splitlines()), "") or f"no IDL that is supported ({type(error).__name__})"


def _place(error: Exception) -> Place | None:
    line, column = getattr(error, "line", None), getattr(error, "column", None)
    if isinstance(line, int) and isinstance(column, int) and line > 0:
        return Place(line, column, column + 1)
    return None

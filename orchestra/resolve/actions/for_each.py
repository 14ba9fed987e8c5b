"""`for_each`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.pyyaml import yaml
from orchestra.resolve.amounts import UnfitError, made
from orchestra.resolve.context import Value
from orchestra.resolve.turns import carry_out

if TYPE_CHECKING:
    from orchestra.description.actions.for_loop import ForEachLoop
    from orchestra.resolve.resolution import Resolution

_SEPARATOR = ";"


def visit(action: ForEachLoop, run: Resolution) -> None:
    """Visit the children once per mapping, with what stands in it as the values of the turn."""
    found = made(action.values, _mappings, run)
    if not isinstance(found, list):
        carry_out(action, None, run)
        return
    at = run.at(action.values.span)
    carry_out(action, ({str(key): Value(str(value), at) for key, value in one.items()} for one in found), run)


def _mappings(text: str) -> list[dict[Any, Any]]:
    """Return the mappings; nothing between two semicolons, and a null, are none."""
    return [
        one
        for piece in text.strip().split(_SEPARATOR)
        if piece and (one := _mapping(piece.strip())) is not None
    ]


def _mapping(text: str) -> dict[Any, Any] | None:
    try:
        found = yaml.safe_load(text)
    except (yaml.YAMLError, ValueError):
        raise UnfitError(f"'{text}' is no YAML") from None
    if found is not None and not isinstance(found, dict):
        raise UnfitError(f"expected a mapping as {{name: value}}, found '{text}'")
    return found

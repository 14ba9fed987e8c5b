"""Captured interfaces as an interface declaration: names as the node itself would use them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.declared.interfaces.model import KINDS

if TYPE_CHECKING:
    from orchestra.declared.capturing.model import Captured


def as_interface(captured: Captured) -> dict[str, list[dict[str, Any]]]:
    """Return the declaration: what is below the node is private (`~/x`), what is in its namespace relative."""
    return {
        kind: [
            {**item, "name": _own_name(item["name"], captured.node)}
            for item in captured.interfaces.get(kind, ())
        ]
        for kind in KINDS
        if captured.interfaces.get(kind)
    }


def _own_name(name: str, node: str) -> str:
    space = f"{node.rpartition('/')[0]}/"
    if name.startswith(f"{node}/"):
        return "~" + name.removeprefix(node)
    return name.removeprefix(space)

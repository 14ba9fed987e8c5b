"""Substitutions as they are described to people."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable


def described(subs: Iterable[Any]) -> str:
    """Return the descriptions of substitutions that are concatenated, with ` + ` between them as upstream."""
    return " + ".join(item.describe() for item in subs)


def said(thing: Any, base: type[Any]) -> str:
    """Return what a class of users says of itself; its name where it says nothing of its own, or fails to.

    Descriptions only serve people: one that raises does not keep the thing from being used, as upstream.
    """
    name = type(thing).__name__
    if type(thing).describe is base.describe:
        return name
    try:
        return str(thing.describe())
    except Exception:  # noqa: BLE001 - the boundary of user code
        return name

"""Substitutions as they are described to people."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

    from orchestra.compat.launch.substitution import Substitution


def described(subs: Iterable[Substitution]) -> str:
    """Return the descriptions of substitutions that are concatenated, with ` + ` between them as upstream."""
    return " + ".join(item.describe() for item in subs)

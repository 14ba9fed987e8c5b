"""Texts and substitutions as a list of substitutions."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.text import normalized

if TYPE_CHECKING:
    from orchestra.compat.launch.substitution import Substitution
    from orchestra.compat.text import Sub


def normalize_to_list_of_substitutions(subs: Sub) -> list[Substitution]:
    """Return a list of substitutions. Raises `TypeError` for anything but texts and substitutions."""
    return normalized(subs)

"""`NotEqualsSubstitution`: whether two values differ."""

from __future__ import annotations

from orchestra.compat.calculating import plain
from orchestra.compat.launch.substitutions.equals_substitution import EqualsSubstitution


class NotEqualsSubstitution(EqualsSubstitution):
    """True where `EqualsSubstitution` is false."""

    _name = "not-equals"


plain.add(NotEqualsSubstitution)

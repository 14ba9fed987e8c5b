"""The types of remapping rules, for annotations."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from orchestra.compat.launch.some_substitutions_type import SomeSubstitutionsType
from orchestra.compat.launch.substitution import Substitution

SomeRemapRule = tuple[SomeSubstitutionsType, SomeSubstitutionsType]
SomeRemapRules = Iterable[SomeRemapRule]
RemapRule = tuple[Sequence[Substitution], Sequence[Substitution]]
RemapRules = Sequence[RemapRule]

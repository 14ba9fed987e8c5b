"""`SomeSubstitutionsType`: a text, a substitution, or several of both."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Union

from orchestra.compat.launch.substitution import Substitution

SomeSubstitutionsType = Union[str, Substitution, Iterable[str | Substitution]]  # noqa: UP007 - evaluated by users' own annotations

SomeSubstitutionsType_types_tuple = (str, Substitution, Iterable)

"""Substitutions that the front ends of YAML and XML build from the arguments in `$(name argument ...)`.

The classes of this room have upstream's `parse`, for code of third parties that calls it or derives from them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Self

from orchestra.compat.calls import CallSubstitution
from orchestra.description.substitutions import SIGNATURES

if TYPE_CHECKING:
    from collections.abc import Sequence


class ParsedSubstitution(CallSubstitution):
    """A call whose arguments are those of the constructor, in order."""

    _parameters: ClassVar[tuple[str, ...]] = ()

    @classmethod
    def parse(cls, data: Sequence[Any]) -> tuple[type[Self], dict[str, Any]]:
        """Return the class and the keywords of its constructor. Raises `TypeError` for too few or too many."""
        signature = SIGNATURES[cls._name]
        if len(data) < signature.minimum or (signature.maximum is not None and len(data) > signature.maximum):
            most = signature.maximum
            some = str(most) if most == signature.minimum else f"{signature.minimum} to {most}"
            raise TypeError(f"$({cls._name}) takes {some} arguments, not {len(data)}")
        return cls, dict(zip(cls._parameters, data, strict=False))

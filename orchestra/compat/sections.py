"""Dictionaries of parameters that are written as a parameter file is, with sections for nodes."""

from __future__ import annotations

from typing import Final

from orchestra.compat.literals import argument
from orchestra.compat.place import here
from orchestra.compat.remarks import remark
from orchestra.errors import Code

_SECTION: Final = "ros__parameters"
_NOTE: Final = "in a dictionary the parameters of the node stand by themselves: parameters=[{'rate': 10.0}]"


def tell_section() -> None:
    """Warn that the names of sections become part of those of the parameters."""
    place = here()
    span = argument(place, ("parameters",)).texts.get(_SECTION, place.span)
    message = f"'{_SECTION}' becomes part of the names of the parameters: only files have sections"
    remark(Code.BAD_NAME, message, span, notes=(_NOTE,))

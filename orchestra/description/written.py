"""How texts and calls are written in a launch file, so that they are read back unchanged."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

_SPECIAL = re.compile(r"([\\$])")
_IN_ARGUMENT = re.compile(r"""([\\$'"()])""")


def escaped(text: str) -> str:
    """Return how a text is written so that it is read back unchanged, alone or beside other text."""
    return _SPECIAL.sub(r"\\\1", text)


def called(name: str, arguments: Iterable[str]) -> str:
    """Return a substitution as written, from the texts of its arguments as written."""
    words = (f"'{argument}'" if not argument or " " in argument else argument for argument in arguments)
    return f"$({' '.join((name, *words))})"

"""Substitutions as Python makes them, in a text of a launch file in YAML or XML: how they are written there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.patterns import pattern

if TYPE_CHECKING:
    import re

MADE: Final = pattern(
    r"(LaunchConfiguration|EnvironmentVariable|FindPackageShare)\(\s*(?:(?:variable_name|name|package)=)?"
    r"([\"'])([A-Za-z_]\w*)\2\s*\)"
)
_CALLED: Final = {
    "LaunchConfiguration": "var",
    "EnvironmentVariable": "env",
    "FindPackageShare": "find-pkg-share",
}


def meant(made: re.Match[str]) -> str:
    """Return how one of them is written."""
    return f"$({_CALLED[made[1]]} {made[3]})"


def without_python(text: str) -> str | None:
    """Return a text with all of them written as they should be, None for one without any."""
    found = MADE.sub(meant, text)
    return None if found == text else found

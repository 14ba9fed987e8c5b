"""What launch files import as `launch.substitutions`."""

from __future__ import annotations

from typing import Any

from orchestra.compat.lazy import exported

_NAMES = {
    "LaunchConfiguration": "launch_configuration",
    "SubstitutionFailure": "substitution_failure",
    "TextSubstitution": "text_substitution",
}

__all__ = sorted(_NAMES)  # noqa: PLE0605 - the names are those of the table

_attribute = exported(__name__, _NAMES)


def __getattr__(name: str) -> Any:
    return _attribute(name)

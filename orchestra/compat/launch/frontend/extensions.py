"""Packages that add to the launch language: the entry points `launch.frontend.launch_extension`."""

from __future__ import annotations

import warnings
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.seam import connection

if TYPE_CHECKING:
    from collections.abc import Iterator

_EXTENSIONS: Final = "launch.frontend.launch_extension"
_PARSERS: Final = "launch.frontend.parser"


def load_extensions() -> None:
    """Import the extensions that are installed, once per resolution; one that fails is warned of."""
    exposures = connection().front_end.exposures
    if not exposures.extended:
        exposures.extended = True
        list(_loaded(_EXTENSIONS))


def parsers_of_third_parties() -> dict[str, Any]:
    """Return the parsers of further languages by name."""
    return dict(_loaded(_PARSERS))


def _loaded(group: str) -> Iterator[tuple[str, Any]]:
    for entry in entry_points(group=group):
        try:
            yield entry.name, entry.load()
        except Exception as error:  # noqa: BLE001 - code of third parties
            message = f"Failed to load {entry.name} of {group}: {type(error).__name__}: {error}"
            warnings.warn(message, stacklevel=2)

"""How a run is to be carried out, as the command line asks: the `options` of the resolver's document."""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields
from typing import Any


@dataclass(frozen=True, slots=True)
class RunOptions:
    """`name` is part of the run directory's name. `fail_on_any` makes any failed process fail the run (status 1).

    `colour` None means: on a terminal, unless `NO_COLOR` or `FORCE_COLOR` says otherwise.
    """

    name: str = "run"
    fail_on_any: bool = False
    colour: bool | None = None


def encode(options: RunOptions) -> dict[str, Any]:
    """Return the options as JSON data."""
    return asdict(options)


def decode(data: Any) -> RunOptions:  # noqa: ANN401 - JSON
    """Read options that `encode` wrote. Raises `ValueError` where a key is unknown."""
    known = {field.name for field in fields(RunOptions)}
    if not isinstance(data, dict) or not known.issuperset(data):
        raise ValueError(f"not the options of a run: {data!r}")
    return RunOptions(**data)

"""How a run is to be carried out, as the command line asks: the `options` of the resolver's document."""

from __future__ import annotations

from typing import Any

from orchestra.dataclass import dataclass
from orchestra.fields import fields


@dataclass(frozen=True, slots=True)
class RunOptions:
    """How to run.

    `name` is that of the run, with a number behind it where a living run has it; one that was asked for (`named`) stays
    as it is, or the run does not begin. `fail_on_any` makes any failed process fail the run (status 1).

    `colour` None means: on a terminal, unless `NO_COLOR` or `FORCE_COLOR` says otherwise. `show_all_output` shows the
    output of every process, whatever the description says. `noninteractive` is accepted as by `ros2 launch`: nothing
    here depends on a terminal. A run that is `detached` has no screen: what processes write is in their logs alone.
    `debug` shows messages of level debug too. `files` is a folder with temporary files of the launch files' code: it
    becomes part of the run directory. Without `warm` each node starts by itself.

    Each log file is put away when it has `log_size` bytes (0: never), and `log_keep` older pieces of it are kept.

    Limits are in seconds: `service_timeout` until the service of a lifecycle node or a container is there,
    `answer_timeout` for its answer, `resolver_timeout` for the code of the description that decides what a trigger
    does.
    """

    name: str = "run"
    named: bool = False
    detached: bool = False
    fail_on_any: bool = False
    colour: bool | None = None
    show_all_output: bool = False
    noninteractive: bool = False
    debug: bool = False
    files: str | None = None
    warm: bool = True
    log_size: int = 64 * 1024 * 1024
    log_keep: int = 7
    service_timeout: float = 60.0
    answer_timeout: float = 60.0
    resolver_timeout: float = 30.0


def encode(options: RunOptions) -> dict[str, Any]:
    """Return the options as JSON data."""
    return {item.name: getattr(options, item.name) for item in fields(options)}


def decode(data: Any) -> RunOptions:  # noqa: ANN401 - JSON
    """Read options that `encode` wrote. Raises `ValueError` where a key is unknown."""
    known = {field.name for field in fields(RunOptions)}
    if not isinstance(data, dict) or not known.issuperset(data):
        raise ValueError(f"not the options of a run: {data!r}")
    return RunOptions(**data)

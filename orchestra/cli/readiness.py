"""What `--detach` tells of the run that has begun, and how `--wait-ready` waits for it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from orchestra.control.client import Client, GoneError
from orchestra.supervise.runs.registry import name_of

if TYPE_CHECKING:
    from collections.abc import Callable

_LOST = frozenset({"failed", "skipped"})


def begun(directory: str, progress: Callable[[], None], *, wait_ready: bool) -> int | None:
    """Print the name of a run that has begun and return 0, None where it ends before it is ready.

    1 where a process will never be ready; the run goes on all the same. `progress` is called when there is news.
    """
    name = name_of(Path(directory))
    lost = _await(Path(directory), progress) if wait_ready else []
    if lost is None:
        return None
    progress()
    sys.stdout.write(f"{name}\n")
    sys.stdout.flush()
    if lost:
        sys.stderr.write(
            f"error: never ready: {', '.join(lost)}; the run goes on: 'orchestra down --run {name}'\n"
        )
    return 1 if lost else 0


def _await(directory: Path, progress: Callable[[], None]) -> list[str] | None:
    """Wait until everything is ready; return what never will be, None where the run is over before."""
    try:
        with Client(directory) as client:
            seen = client.ask("subscribe")
            while True:
                progress()
                processes = seen["processes"]
                lost = [one for one in processes if one["phase"] in _LOST]
                # There are none before the run has begun: it may be that we are that early.
                if not _ends(seen, lost) and (lost or (processes and all(map(_settled, processes)))):
                    return [f"{one['name']} ({one['ending'] or one['phase']})" for one in lost]
                client.await_event()
                seen = client.ask("snapshot")
    except GoneError:
        return None


def _ends(seen: dict[str, Any], lost: list[dict[str, Any]]) -> bool:
    """Tell whether the run comes to its end: it does, or is about to, because what it cannot be without is lost."""
    return bool(seen["ending"]) or any(one["required"] for one in lost)


def _settled(process: dict[str, Any]) -> bool:
    """Tell whether nothing more is to come of a process by itself."""
    if process["phase"] == "running":
        return process["awaited"] is None
    return process["phase"] in ("ready", "exited") or (process["phase"] == "waiting" and process["held"])

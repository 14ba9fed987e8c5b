"""What `logs` and `events` share: since when, which processes, and how a time is written."""

from __future__ import annotations

import re
import time
from datetime import datetime
from typing import TYPE_CHECKING

from orchestra import events
from orchestra.control.selection import UnmatchedError, select
from orchestra.errors import UsageError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

_AGO = re.compile(r"(\d+(?:\.\d+)?)([smhd]?)")
_SECONDS = {"": 1, "s": 1, "m": 60, "h": 3600, "d": 86400}


def since(text: str) -> float:
    """Return the time that is meant, in seconds since the epoch: `10s`, `5m`, `2h`, `1d` ago, or ISO 8601.

    A date without a zone is of the zone that the machine is in. Raises `UsageError`.
    """
    ago = _AGO.fullmatch(text)
    if ago:
        return time.time() - float(ago[1]) * _SECONDS[ago[2]]
    try:
        return datetime.fromisoformat(text).timestamp()
    except ValueError:
        raise UsageError(f"'{text}' is no time: 10s, 5m, 2h, 1d or 2026-08-21T10:30:00") from None


def clock(moment: float) -> str:
    """Return the time of day, in the zone of the machine, to the millisecond."""
    thousandths = int(moment * 1000) % 1000
    return f"{time.strftime('%H:%M:%S', time.localtime(moment))}.{thousandths:03}"


def selected(patterns: Sequence[str], directory: Path, *others: str) -> frozenset[str] | None:
    """Return the ids that patterns mean in a run, None where every process is meant; `others` are names besides.

    Raises `UsageError` for a pattern that means none.
    """
    if not patterns:
        return None
    try:
        return frozenset(select(patterns, [*processes(directory), *others]))
    except UnmatchedError as error:
        raise UsageError(str(error)) from error


def processes(directory: Path) -> list[str]:
    """Return every process that the run has, or had: each waited once."""
    known: dict[str, None] = {}
    with (directory / "events.jsonl").open("rb") as lines:
        for line in lines:
            if b'"process_waiting"' in line:
                try:
                    event = events.loads(line)
                except ValueError:
                    continue  # torn: it is just being written
                if event.process is not None:
                    known[event.process] = None
    return list(known)

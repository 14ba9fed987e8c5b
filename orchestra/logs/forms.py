"""How a gap is told in each kind of file: where the disk took nothing, a line says how much is missing."""

from __future__ import annotations

import time
from typing import Final

from orchestra import events
from orchestra.logs import records
from orchestra.logs.rotation import Form


def _missing(size: int) -> str:
    return f"{size} bytes are missing here: they could not be written"


def _in_output(size: int) -> bytes:
    return f"\n[orchestra] {_missing(size)}\n".encode()


def _in_records(size: int) -> bytes:
    record = records.Record(time.time(), None, None, records.OURS, "warn", None, _missing(size))
    return f"{records.dumps(record)}\n".encode()


def _in_events(size: int) -> bytes:
    event = events.Event(time.time(), time.monotonic(), "message", data={"text": _missing(size)})
    return f"{events.dumps(event)}\n".encode()


OUTPUT: Final = Form(_in_output, whole=False)
RECORDS: Final = Form(_in_records, whole=True)
EVENTS: Final = Form(_in_events, whole=True)

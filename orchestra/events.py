"""What happened in a run: one event is one line of JSON, and the stream of them tells the whole run."""

from __future__ import annotations

import json
from math import isfinite
from typing import Any, Literal, TypeAlias

from orchestra.dataclass import dataclass
from orchestra.fields import field

Kind: TypeAlias = Literal[
    "run_started",  # data: run, name, directory, file
    "run_stopping",  # cause says why
    "run_ended",  # data: status, reason, failed; always the last event
    "process_waiting",
    "process_starting",
    "process_running",  # the program runs; data: start, which counts from 1
    "started_cold",  # the fork server was to start it, and could not; data: reason
    "process_ready",
    "process_stopping",
    "process_restarting",  # data: delay, short_runs
    "process_exited",  # for good, as it should; data: code, signal, uptime
    "process_failed",  # for good, not as it should; data as above, reason where it never ran, hang
    "process_skipped",
    "process_ended",  # one run of it is over, whatever follows; data: code, signal, reason, hang, uptime
    "process_hung",  # a sign of life is missing; data: reason, threads (what /proc tells of each)
    "crash_recorded",  # an end that nobody wanted has a dossier; data: folder
    "signal_sent",  # data: signal
    "descendant_adopted",  # a child of a process detached itself; data: command
    "left_behind",  # something outlived its process or the run; data: command
    "trigger_fired",  # data: trigger, on, do; process is what set it off
    "plan_revised",  # data: trigger, revision, and what it added: processes, components, triggers, do, problems
    "state_changed",  # of a lifecycle node; data: transition, start_state, goal_state
    "transition_done",  # an order to a lifecycle node; data: transition, state
    "transition_failed",  # data: transition, reason
    "component_loaded",  # process is the id of the component; data: node, container, unique_id
    "component_failed",  # data: container, reason
    "message",  # what the user was told; data: text
]


@dataclass(frozen=True, slots=True)
class Event:
    """One thing that happened.

    `time` is in seconds since the epoch, `monotonic` in seconds of the machine's monotonic clock. `process` is the id
    in the plan, None for what concerns the run as a whole.
    """

    time: float
    monotonic: float
    kind: Kind
    process: str | None = None
    pid: int | None = None
    cause: str | None = None
    data: dict[str, Any] = field(default_factory=dict)


# Made once: `json.dumps` makes one for each call.
_JSON = json.JSONEncoder(ensure_ascii=False)
_text = json.encoder.encode_basestring


def dumps(event: Event) -> str:
    """Return the event as one line of JSON, without its newline.

    There are half a dozen for each life of a process, so all but `data` is put together here.
    """
    process = "null" if event.process is None else _text(event.process)
    pid = "null" if event.pid is None else event.pid
    cause = "null" if event.cause is None else _text(event.cause)
    data = _encoded(event.data) if event.data else "{}"
    return (
        f'{{"time": {event.time!r}, "monotonic": {event.monotonic!r}, "kind": "{event.kind}", '
        f'"process": {process}, "pid": {pid}, "cause": {cause}, "data": {data}}}'
    )


def _encoded(data: dict[str, Any]) -> str:
    """Return the data as JSON; by hand, in half the time, where it holds nothing but texts, numbers and nulls."""
    entries = []
    for name, value in data.items():
        kind = type(value)
        if value is None:
            entries.append(f"{_text(name)}: null")
        elif kind is str:
            entries.append(f"{_text(name)}: {_text(value)}")
        elif kind is int or (kind is float and isfinite(value)):
            entries.append(f"{_text(name)}: {value!r}")
        else:
            return _JSON.encode(data)
    return f"{{{', '.join(entries)}}}"


def loads(line: str | bytes) -> Event:
    """Read one line of an event stream. Raises `ValueError` where it is none."""
    document = json.loads(line)
    if not isinstance(document, dict):
        raise ValueError("an event is a JSON object")  # noqa: TRY004 - a fault of the text, not of a type
    try:
        return Event(**document)
    except TypeError as error:
        raise ValueError(f"not an event: {error}") from error

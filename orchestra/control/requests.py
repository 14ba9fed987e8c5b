"""What clients may ask for, one function per request, and the table of them.

    snapshot                                          the run and how its processes stand
    subscribe                                         the same, and every event from then on
    start, stop, restart  processes, wait             `processes` are names or patterns (`selection`)
    signal                processes, signal           by name or number
    down                  reason                      the end of the run; `run_ended` is its last event
    attach, input, resize, detach                     `attaching` says more

The first two answer `{"run": HELLO, "ending": whether it is coming to its end, "processes": [STANDING, ...]}`.
`start`, `stop` and `restart` answer `{"refused": {ID: WHY, ...}, "processes": {ID: STANDING, ...}}` when what they
concern is at rest, or at once where `wait` is false. A standing has the fields of
`orchestra.supervise.operation.Standing`.
"""

from __future__ import annotations

import signal
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

from orchestra.control import protocol
from orchestra.control.attaching import Attaching
from orchestra.control.protocol import Refusal
from orchestra.control.selection import UnmatchedError, select
from orchestra.control.subscribers import Subscribers
from orchestra.control.waiting import Waiting
from orchestra.dataclass import dataclass
from orchestra.fields import fields
from orchestra.supervise.operation import Operation, Standing

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from orchestra.control.guest import Guest
    from orchestra.control.protocol import Request

_FIELDS = tuple(field.name for field in fields(Standing))
_BY_AN_OPERATOR = "an operator ended it"


@dataclass(frozen=True, slots=True)
class Desk:
    """Whom requests concern. `run` is the hello."""

    run: Mapping[str, Any]
    operation: Operation
    subscribers: Subscribers
    waiting: Waiting
    attaching: Attaching


def _snapshot(desk: Desk, guest: Guest, request: Request) -> None:
    guest.send(protocol.answer(request.id, _seen(desk)))


def _subscribe(desk: Desk, guest: Guest, request: Request) -> None:
    """Nothing can happen between the two, so that no event is missed and none comes twice."""
    guest.send(protocol.answer(request.id, {**_seen(desk), "events": desk.subscribers.count}))
    desk.subscribers.add(guest)


def _seen(desk: Desk) -> dict[str, Any]:
    return {
        "run": dict(desk.run),
        "ending": desk.operation.ending,
        "processes": [_told(found) for found in desk.operation.processes()],
    }


def _told(standing: Standing) -> dict[str, Any]:
    """Return a standing as JSON data; `dataclasses.asdict` would copy every value of it."""
    return {name: getattr(standing, name) for name in _FIELDS}


def _start(desk: Desk, guest: Guest, request: Request) -> None:
    _change(desk, guest, request, desk.operation.start)


def _stop(desk: Desk, guest: Guest, request: Request) -> None:
    _change(desk, guest, request, desk.operation.stop)


def _restart(desk: Desk, guest: Guest, request: Request) -> None:
    _change(desk, guest, request, desk.operation.restart)


def _change(
    desk: Desk,
    guest: Guest,
    request: Request,
    change: Callable[[Iterable[str]], dict[str, str | None]],
) -> None:
    wait = request.given.get("wait", True)
    refused = {name: why for name, why in change(_selected(desk, request)).items() if why is not None}
    concerned = [name for name in _selected(desk, request) if name not in refused]

    def answer(standings: dict[str, Standing] | None) -> None:
        if standings is None:
            guest.send(protocol.refusal(request.id, Refusal("over", "the run ended meanwhile")))
            return
        processes = {name: _told(standing) for name, standing in standings.items()}
        guest.send(protocol.answer(request.id, {"refused": refused, "processes": processes}))

    if wait and concerned:
        guest.at_leave(desk.waiting.until_rest(concerned, answer))
    else:
        answer({found.id: found for found in desk.operation.processes() if found.id in concerned})


def _signal(desk: Desk, guest: Guest, request: Request) -> None:
    number = signal_number(request.given.get("signal"))
    told = desk.operation.signal(_selected(desk, request), number)
    refused = {name: why for name, why in told.items() if why is not None}
    processes = {
        found.id: _told(found)
        for found in desk.operation.processes()
        if found.id in told and found.id not in refused
    }
    guest.send(protocol.answer(request.id, {"refused": refused, "processes": processes}))


def signal_number(given: object) -> int:
    """Return the number of a signal given as such, or as a name with or without `SIG`. Raises `Refusal`."""
    text = str(given).strip().upper()
    known = {found.name: int(found) for found in signal.Signals}
    number = int(text) if text.isdecimal() else known.get(text if text in known else f"SIG{text}", 0)
    if isinstance(given, bool) or number not in signal.valid_signals():
        raise Refusal("unknown_signal", f"there is no signal '{given}'")
    return number


def _down(desk: Desk, guest: Guest, request: Request) -> None:
    guest.send(protocol.answer(request.id, {}))
    desk.operation.down(str(request.given.get("reason") or _BY_AN_OPERATOR))


def _attach(desk: Desk, guest: Guest, request: Request) -> None:
    process = request.given.get("process")
    chosen = _fitting(desk, [process])
    if len(chosen) != 1:
        raise Refusal("malformed", f"'{process}' is {len(chosen)} processes, and one can be attached to")
    guest.send(protocol.answer(request.id, desk.attaching.begin(guest, chosen[0], request.given)))


def _input(desk: Desk, guest: Guest, request: Request) -> None:
    guest.send(protocol.answer(request.id, desk.attaching.input(guest, request.given)))


def _resize(desk: Desk, guest: Guest, request: Request) -> None:
    guest.send(protocol.answer(request.id, desk.attaching.resize(guest, request.given)))


def _detach(desk: Desk, guest: Guest, request: Request) -> None:
    guest.send(protocol.answer(request.id, desk.attaching.detach(guest)))


def _selected(desk: Desk, request: Request) -> list[str]:
    patterns = request.given.get("processes")
    if not isinstance(patterns, list) or not patterns:
        raise Refusal("malformed", "'processes' is a list of names or patterns")
    return _fitting(desk, patterns)


def _fitting(desk: Desk, patterns: list[object]) -> list[str]:
    if not all(isinstance(pattern, str) and pattern for pattern in patterns):
        raise Refusal("malformed", "names and patterns of processes are texts")
    try:
        return select(map(str, patterns), [found.id for found in desk.operation.processes()])
    except UnmatchedError as error:
        raise Refusal("unknown_process", str(error)) from None


REQUESTS: Final[dict[str, Callable[[Desk, Guest, Request], None]]] = {
    "snapshot": _snapshot,
    "subscribe": _subscribe,
    "start": _start,
    "stop": _stop,
    "restart": _restart,
    "signal": _signal,
    "down": _down,
    "attach": _attach,
    "input": _input,
    "resize": _resize,
    "detach": _detach,
}


def handler_of(name: str) -> Callable[[Desk, Guest, Request], None]:
    """Return what sees to a request. Raises `Refusal` where there is none of this name."""
    if name in REQUESTS:
        return REQUESTS[name]
    from orchestra.nearest import nearest  # noqa: PLC0415 - difflib is slow to import, and most names are right

    meant = nearest(name[:40], REQUESTS)
    hint = f"; did you mean '{meant}'?" if meant else ""
    raise Refusal("unknown_request", f"there is no request '{name:.40}'{hint}")

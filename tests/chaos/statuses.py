"""The exit status that docs/design.md promises for what befell a run."""

from __future__ import annotations

import re
import signal
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from orchestra.events import Event
    from tests.chaos.acting import Delivery
    from tests.chaos.cases import Case, Root
    from tests.chaos.playing import Observation

_FAILED = 1
_SIGNALLED = 128
# Why a run ends where nothing has failed.
_SUCCESS = re.compile(r"required process \S+ has ended|an operator ended it")
_STOP_SIGNALS = ("INT", "TERM", "HUP")


class Fate(NamedTuple):
    """What befell the processes of Orchestra itself."""

    keeper_killed: bool
    supervisor_killed: bool
    supervisor_frozen: bool
    stop_signals: tuple[int, ...]


def fate(seen: Observation) -> Fate:
    """Return what befell Orchestra itself."""
    return Fate(
        keeper_killed=any(_hit(each, "keeper", "KILL") for each in seen.deliveries),
        supervisor_killed=any(_hit(each, "supervisor", "KILL") for each in seen.deliveries),
        supervisor_frozen=_frozen(seen.deliveries),
        stop_signals=tuple(number for each in seen.deliveries if (number := _stop_signal(each))),
    )


def allowed(case: Case, seen: Observation) -> set[int]:
    """Return the exit statuses that are in order."""
    befell = fate(seen)
    ended = _last_of(seen.events, "run_ended")
    if befell.keeper_killed:
        # It may have been ending already, and be no more than a zombie when it was killed.
        own = {ended.data["status"]} if ended else _without_events(case, befell) if case.disk else set()
        return {-signal.SIGKILL, *own}
    if befell.supervisor_killed or befell.supervisor_frozen:
        return {_FAILED} if ended is None else {_FAILED, ended.data["status"]}
    if _last_of(seen.events, "run_started") is None:
        return _refused(case, seen, befell) | (_without_events(case, befell) if case.disk else set())
    return _as_described(case, seen, befell)


def _refused(case: Case, seen: Observation, befell: Fate) -> set[int]:
    """No run came about: its directory, too, needs room on the disk."""
    resolver = any(each.act.target == "resolver" and each.pid for each in seen.deliveries)
    found = {_SIGNALLED + number for number in befell.stop_signals[:1]}
    if resolver or case.disk:
        found.add(_FAILED)
    return found


def _as_described(case: Case, seen: Observation, befell: Fate) -> set[int]:
    if case.disk:
        return _without_events(case, befell)
    stopping = _last_of(seen.events, "run_stopping")
    before = seen.events if stopping is None else seen.events[: seen.events.index(stopping) + 1]
    required = {root.member.name for root in case.roots if root.required}
    codes = {
        _status(event) for event in before if event.kind == "process_failed" and event.process in required
    }
    if codes:
        return codes
    cause = (stopping.cause or "") if stopping else ""
    if cause in {f"SIG{name}" for name in _STOP_SIGNALS}:
        return {_SIGNALLED + signal.Signals[cause]}
    natural = 0 if stopping is None or _SUCCESS.fullmatch(cause) else _FAILED
    # A signal may have come while the run was ending for that cause.
    return {natural, *(_SIGNALLED + number for number in befell.stop_signals[:1])}


def _without_events(case: Case, befell: Fate) -> set[int]:
    """Where the disk was full the events do not tell what came first."""
    codes = {root.member.code for root in case.roots if root.required}
    codes |= (
        {_SIGNALLED + signal.Signals[f"SIG{name}"] for name in ("KILL", "SEGV", "TERM")} if codes else set()
    )
    return {0, *codes, *(_SIGNALLED + number for number in befell.stop_signals[:1])}


def _status(event: Event) -> int:
    code = event.data.get("code")
    return int(code) if code is not None else _SIGNALLED + int(event.data["signal"])


def _last_of(events: tuple[Event, ...], kind: str) -> Event | None:
    return next((event for event in reversed(events) if event.kind == kind), None)


def _hit(delivery: Delivery, target: str, name: str) -> bool:
    act = delivery.act
    return delivery.pid is not None and act.deed == "signal" and (act.target, act.signal) == (target, name)


def _frozen(deliveries: tuple[Delivery, ...]) -> bool:
    """Tell whether the supervisor was stopped and nobody has woken it; the keeper does where it wants it to end."""
    frozen = False
    for each in deliveries:
        if _hit(each, "supervisor", "STOP"):
            frozen = True
        elif _hit(each, "supervisor", "CONT") or (each.act.target == "keeper" and _stop_signal(each)):
            frozen = False
    return frozen


def _stop_signal(delivery: Delivery) -> int | None:
    act = delivery.act
    if delivery.pid is None or (act.deed == "signal" and act.target not in ("keeper", "supervisor")):
        return None
    if act.deed == "hang up":
        return signal.SIGHUP
    return signal.Signals[f"SIG{act.signal}"] if act.signal in _STOP_SIGNALS else None


def judged_roots(case: Case) -> list[Root]:
    """Return those whose output is counted: nobody closes it."""
    return [root for root in case.roots if root.member.lines is not None and not root.member.closes]

"""How often processes are asked to stop: counted, since times vary."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

from orchestra.supervise.process.life import Phase, StopRequested
from orchestra.supervise.process.stopping import Stopping
from tests.supervise.plans import after, process

_MANY = 60


class _Unit:
    """One that runs, and notes what it is told."""

    def __init__(self, number: int) -> None:
        self.id = f"p{number}"
        self.process = process(self.id, depends_on=after(f"p{number - 1}", "started") if number else ())
        self.state = SimpleNamespace(phase=Phase.RUNNING)
        self.requests = 0

    def handle(self, event: object) -> None:
        if isinstance(event, StopRequested):
            self.requests += 1
            self.state.phase = Phase.STOPPING


def test_who_waits_for_one_another_is_asked_once_and_in_turn() -> None:
    loop = SimpleNamespace(clock=lambda: 0.0, call_later=lambda _delay, _callback: None)
    around: Any = SimpleNamespace(
        loop=loop, recorder=SimpleNamespace(record=lambda *_, **__: None), more_time=lambda _: True
    )
    units: dict[str, Any] = {unit.id: unit for unit in map(_Unit, range(_MANY))}
    stopping = Stopping(units, around)
    stopping.begin("test")
    for number in reversed(range(_MANY)):
        stopping.go_on()
        assert [unit.id for unit in units.values() if unit.state.phase is Phase.STOPPING] == [f"p{number}"]
        units[f"p{number}"].state.phase = Phase.EXITED
        stopping.changed(f"p{number}")
    assert [unit.requests for unit in units.values()] == [1] * _MANY

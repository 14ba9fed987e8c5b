"""How long what has been killed is waited for before it is named as what cannot be stopped."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.supervise.keeping import proc
from orchestra.supervise.process.life import Phase
from orchestra.supervise.process.stopping import Stopping

if TYPE_CHECKING:
    from collections.abc import Callable


class Loop:
    """Time that passes from call to call."""

    def __init__(self) -> None:
        self.now = 0.0
        self.calls: list[tuple[float, Callable[[], object]]] = []

    def clock(self) -> float:
        return self.now

    def call_later(self, delay: float, callback: Callable[[], object]) -> None:
        self.calls.append((self.now + delay, callback))

    def run(self) -> None:
        while self.calls:
            self.now, callback = self.calls.pop(0)
            callback()


@pytest.mark.parametrize(
    ("waits", "kept", "until"),
    [
        pytest.param(0.0, True, 0.7, id="in an uninterruptible wait"),
        pytest.param(3.0, True, 3.5, id="for a processor at first"),
        pytest.param(100.0, True, 10.5, id="for a processor for ever"),
        pytest.param(100.0, False, 0.7, id="for a processor, without a keeper that waits too"),
    ],
)
def test_what_waits_for_a_processor_may_still_end(
    monkeypatch: pytest.MonkeyPatch, waits: float, *, kept: bool, until: float
) -> None:
    loop = Loop()
    monkeypatch.setattr(proc, "is_runnable", lambda _pid: loop.now < waits)
    unit: Any = SimpleNamespace(
        name="a", pid=1, state=SimpleNamespace(phase=Phase.STOPPING), handle=lambda _event: None
    )
    around: Any = SimpleNamespace(
        loop=loop, more_time=lambda _seconds: kept, journal=SimpleNamespace(say=lambda _text: None)
    )
    stopping = Stopping({"a": unit}, around)
    stopping._deadline()
    loop.run()
    assert stopping.given_up
    assert loop.now == pytest.approx(until)

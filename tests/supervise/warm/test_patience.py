"""How long a start may take: the server makes one after the other, which on a busy machine takes its time."""

from __future__ import annotations

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.supervise.warm.starts import Starts

if TYPE_CHECKING:
    from collections.abc import Callable

_LIMIT = 15.0


class _Loop:
    """A loop whose time goes on when it is told to."""

    def __init__(self) -> None:
        self.now = 100.0
        self.waiting: list[tuple[float, Callable[[], None]]] = []

    def clock(self) -> float:
        return self.now

    def call_later(self, seconds: float, call: Callable[[], None]) -> Any:
        entry = (self.now + seconds, call)
        self.waiting.append(entry)
        return SimpleNamespace(cancel=lambda: self.waiting.remove(entry))

    def wait(self, seconds: float) -> None:
        end = self.now + seconds
        while due := sorted((entry for entry in self.waiting if entry[0] <= end), key=lambda entry: entry[0]):
            self.waiting.remove(due[0])
            self.now = max(self.now, due[0][0])
            due[0][1]()
        self.now = end


class _Start:
    """A start that somebody waits for."""

    def __init__(self, given_up: list[str], over: Callable[[], None], since: float) -> None:
        self.process = SimpleNamespace(id="/n")
        self.pid: int | None = None
        self.since, self.withdrawn = since, False
        self.over, self._given_up = over, given_up

    def there(self, pid: int) -> None:
        self.pid = pid

    def give_up(self, reason: str) -> None:
        self._given_up.append(reason)
        self.over()


class _Case:
    """Starts of which some are under way."""

    def __init__(self) -> None:
        self.loop, self.given_up = _Loop(), list[str]()
        kin: Any = SimpleNamespace(add=lambda *_: None, remove=lambda *_: None)
        self.starts = Starts(self.loop, kin, "run", lambda _text: None)  # type: ignore[arg-type]
        self.starts._server = SimpleNamespace(kill=lambda: None, leave=lambda: None)  # type: ignore[assignment]

    def ask(self, number: int) -> None:
        start: Any = _Start(self.given_up, lambda: self.starts._close(number), self.loop.now)
        self.starts._open[number] = start
        self.starts._be_patient()

    def answer(self, number: int) -> None:
        self.starts._heard({"id": number, "pid": 1000 + number})
        self.starts._open[number].since = self.loop.now

    def begin(self, number: int) -> None:
        self.starts._close(number)


@pytest.fixture
def case() -> _Case:
    return _Case()


def test_a_server_that_makes_one_after_the_other_is_waited_for(case: _Case) -> None:
    for number in range(10):
        case.ask(number)
    for number in range(10):
        case.loop.wait(_LIMIT - 1)
        case.answer(number)
        case.begin(number)
    assert not case.given_up
    assert not case.loop.waiting


def test_one_that_answers_no_more_is_not(case: _Case) -> None:
    for number in range(3):
        case.ask(number)
    case.loop.wait(_LIMIT - 1)
    case.answer(0)
    case.begin(0)
    case.loop.wait(_LIMIT - 1)
    assert not case.given_up
    case.loop.wait(2)
    assert case.given_up == ["the fork server has not answered for 15 s"] * 2
    assert not case.loop.waiting


def test_that_others_are_asked_for_does_not_help_it(case: _Case) -> None:
    for number in range(4):
        case.ask(number)
        case.loop.wait(4)
    assert len(case.given_up) == 4


def test_a_node_that_does_not_begin_is_given_up_whatever_the_server_makes(case: _Case) -> None:
    case.ask(0)
    case.answer(0)
    for number in range(1, 5):
        case.loop.wait(4)
        case.ask(number)
        case.answer(number)
        case.begin(number)
    assert case.given_up == ["it has not begun for 15 s"]
    assert not case.loop.waiting

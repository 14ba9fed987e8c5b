from __future__ import annotations

import os

from orchestra.supervise.loop import Loop


class Clock:
    """A clock that stands until it is moved."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


def test_timers_fire_in_order_of_time_and_then_of_making() -> None:
    clock = Clock()
    loop = Loop(clock)
    fired: list[str] = []
    for delay, name in ((2.0, "c"), (1.0, "a"), (1.0, "b"), (9.0, "z")):
        loop.call_later(delay, lambda name=name: fired.append(name))  # type: ignore[misc]
    clock.now += 5.0
    loop.run_once()
    assert fired == ["a", "b", "c"]
    loop.close()


def test_a_cancelled_timer_does_not_fire_and_does_not_wake() -> None:
    clock = Clock()
    loop = Loop(clock)
    loop.call_later(0.0, lambda: None).cancel()
    assert loop._until_next_timer() is None
    loop.close()


def test_a_timer_made_by_a_timer_waits_for_the_next_round() -> None:
    loop = Loop()
    fired: list[int] = []
    loop.call_later(0.0, lambda: loop.call_later(0.0, lambda: fired.append(2)))
    loop.run_once()
    assert fired == []
    loop.run_once()
    assert fired == [2]
    loop.close()


def test_a_timer_cancelled_by_another_of_the_same_round_stays_silent() -> None:
    loop = Loop()
    fired: list[str] = []
    loop.call_later(0.0, lambda: second.cancel())  # noqa: PLW0108 - it is bound below
    second = loop.call_later(0.0, lambda: fired.append("second"))
    loop.run_once()
    assert fired == []
    loop.close()


def test_a_descriptor_forgotten_in_the_same_round_is_not_called() -> None:
    loop = Loop()
    pipes = [os.pipe(), os.pipe()]
    called: list[int] = []

    def forget_the_other(own: int, other: int) -> None:
        called.append(own)
        loop.forget(other)

    (first, _), (second, _) = pipes
    loop.on_readable(first, lambda: forget_the_other(first, second))
    loop.on_readable(second, lambda: forget_the_other(second, first))
    for _, writable in pipes:
        os.write(writable, b"x")
    loop.run_once()
    assert len(called) == 1
    loop.close()
    for descriptor in (*pipes[0], *pipes[1]):
        os.close(descriptor)


def test_a_timer_may_be_further_away_than_the_kernel_can_wait() -> None:
    clock = Clock()
    loop = Loop(clock)
    fired: list[str] = []
    loop.call_later(1e12, lambda: fired.append("late"))
    readable, writable = os.pipe()
    os.write(writable, b"x")
    loop.on_readable(readable, lambda: fired.append("readable"))
    loop.run_once()
    assert fired == ["readable"]
    clock.now += 1e12
    loop.forget(readable)
    loop.run_once()
    assert fired == ["readable", "late"]
    os.close(readable)
    os.close(writable)
    loop.close()

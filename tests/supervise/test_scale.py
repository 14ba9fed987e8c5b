"""Many processes: all of them start and stop, nothing of what they write is lost, and nothing of them is kept."""

from __future__ import annotations

import resource
import signal
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.control.client import Client
from orchestra.values import Stop
from tests.chaos import outputs
from tests.chaos.cases import Member
from tests.chaos.describing import command_of
from tests.supervise.effort import descriptors, memory
from tests.supervise.plans import launched, plan, process, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.plan.model import Process
    from tests.supervise.plans import Launched

_MANY = 200
# Nobody is to be killed because the machine is slow.
_PATIENT = Stop(timeout=60.0, kill_timeout=30.0)
_WAVE, _WAVES = 40, 5
_LIMIT = 100
_LIMITED = ("/bin/sh", "-c", f'ulimit -S -n {_LIMIT}; exec "$@"', "sh")
# The interpreter keeps some of what it has freed; a tenth of it for each process that has gone would show.
_KEPT_AT_MOST = 1024 * 1024


def writer(number: int) -> Process:
    """Return a process that writes some lines, or goes on writing, and finishes its output when it is stopped."""
    lines, floods = 25 * (number % 8), number % 20 == 0
    member = Member(f"p{number}", lines=lines, floods=floods, polite=True)
    return process(
        member.name, command=command_of(member, "scale"), stop=_PATIENT, emulate_tty=number % 5 == 0
    )


def sleepers(count: int, **changes: Any) -> list[Process]:
    """Return processes that do nothing and end at once when they are asked to."""
    return [process(f"p{n}", command=("/bin/sleep", "1000"), **changes) for n in range(count)]


def test_two_hundred_write_and_are_stopped(tmp_path: Path) -> None:
    with launched(tmp_path, plan(*map(writer, range(_MANY)))) as run:
        await_running(run, _MANY)
        wait_for(lambda: all(f"up p{n} " in log_of(run, n) for n in range(_MANY)), "what they all say")
        run.send(signal.SIGINT)
        assert run.wait(120.0) == 130
        run.assert_gone()
        assert [event.data["code"] for event in run.of_kind("process_ended")] == [0] * _MANY
        assert [*_wrong_logs(run)] == []


def log_of(run: Launched, number: int) -> str:
    """Return what a process has written so far."""
    path = run.directory / "logs" / f"p{number}.log"
    return path.read_text("utf-8") if path.exists() else ""


def _wrong_logs(run: Launched) -> Iterator[str]:
    for number in range(_MANY):
        streams = "o" if number % 5 == 0 else "oe"
        whole, faults = outputs.check(log_of(run, number).encode())
        if faults or any(whole[letter] != 1 for letter in streams):
            yield f"p{number}: {whole}, {faults[:3]}"


def test_nothing_is_kept_of_what_has_gone(tmp_path: Path) -> None:
    changes: dict[str, Any] = {"emulate_tty": True, "stop": _PATIENT}
    folder = {"XDG_RUNTIME_DIR": str(tmp_path)}
    held = []
    with launched(tmp_path, plan(*sleepers(_WAVE, **changes)), environment=folder) as run:
        await_running(run, _WAVE)
        supervisor = run.own("orc-supervisor")
        with Client(run.directory) as client:
            for _ in range(_WAVES + 1):
                client.ask("stop", processes=["*"])
                held.append((descriptors(supervisor), memory(supervisor)))
                client.ask("start", processes=["*"])
        run.send(signal.SIGINT)
        assert run.wait(120.0) == 130
    assert {count for count, _ in held} == {held[0][0]}
    assert held[-1][1] - held[1][1] < _KEPT_AT_MOST, held


def test_many_processes_need_no_higher_limit_of_open_files(tmp_path: Path) -> None:
    """The soft limit is for programs, which still have it, and not for who has a handful of files for each of them."""
    asking = process("asking", command=("/bin/sh", "-c", "ulimit -S -n"))
    with launched(tmp_path, plan(asking, *sleepers(_LIMIT // 2)), through=_LIMITED) as run:
        await_running(run, 1 + _LIMIT // 2)
        assert not run.of_kind("process_failed")
        run.await_line("asking", str(_LIMIT))
        run.send(signal.SIGINT)
        assert run.wait(120.0) == 130


@pytest.mark.long
@pytest.mark.timeout(600)
def test_effort_grows_as_the_number_of_processes_does(tmp_path: Path) -> None:
    """Of each size the cheapest of three runs: others on the machine, and a first import, make one dearer than it is.

    Effort that grew with the square of the number would make the second four times as much as the first.
    """
    few, some, many = 50, 200, 800
    costs = {
        count: min(_cost(tmp_path / f"{count}-{turn}", count) for turn in range(3))
        for count in (few, some, many)
    }
    first, second = (costs[some] - costs[few]) / (some - few), (costs[many] - costs[some]) / (many - some)
    assert second < 2 * first, costs


def _cost(folder: Path, count: int) -> float:
    """Return the seconds of computing for a run that starts and stops so many processes, these included."""
    folder.mkdir()
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with launched(folder, plan(*sleepers(count, stop=_PATIENT))) as run:
        await_running(run, count)
        run.send(signal.SIGINT)
        assert run.wait(120.0) == 130
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def await_running(run: Launched, count: int) -> None:
    """Wait until so many processes run."""
    run.await_event("process_running", count=count)

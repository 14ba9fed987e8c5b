"""Observers that die, hang or talk nonsense: whoever waits for them hears a defined word."""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.supervise.graph.lookout import Patience
from orchestra.supervise.graph.observation import Observers
from orchestra.supervise.keeping import proc
from orchestra.supervise.keeping.kin import Kin
from orchestra.supervise.loop import Loop
from tests.supervise.plans import PATIENCE, PROCESSES, wait_for

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

# With one that says nothing, with such a one before another that is to answer in time, and with all others.
QUICK = Patience(every=0.1, answer=0.5, start=1.0, lasting=60.0)
PATIENT = QUICK._replace(answer=2.0, start=3.0)
ENDLESS = QUICK._replace(answer=60.0, start=60.0)
WATCH = {"do": "watch", "fact": "node", "name": "/n"}
CHANGE = {"do": "change_state", "node": "/n", "transition": 3}
LOAD = {"do": "load", "container": "/c", "component": {}}


class Run:
    """Observers on a loop of their own, and everything that was heard from them."""

    def __init__(self, folder: Path, manners: str, patience: Patience) -> None:
        self.folder = folder
        self.loop = Loop()
        self.told: list[str] = []
        self.heard: list[dict[str, Any]] = []
        command = (sys.executable, "-S", "-E", str(PROCESSES / "odd_observer.py"), str(folder), manners)
        self.observers = Observers(self.loop, Kin(""), self.told.append, command=command, patience=patience)

    def order(self, name: str, order: dict[str, Any], *, domain: str = "1") -> None:
        environment = {**os.environ, "ROS_DOMAIN_ID": domain}
        self.observers.order(name, order, environment, self.heard.append)

    def until(self, condition: Callable[[], Any]) -> None:
        """Let the loop run until a condition holds; what observers write to files wakes nobody up."""
        deadline = time.monotonic() + PATIENCE
        while not condition():
            assert time.monotonic() < deadline, (self.heard, self.told)
            tick = self.loop.call_later(0.02, lambda: None)
            self.loop.run_once()
            tick.cancel()

    def words(self) -> list[tuple[str, str]]:
        return [(message["id"].split()[-1], message["say"]) for message in self.heard]

    def orders(self, number: int) -> list[dict[str, Any]]:
        """What the n-th observer was told, pings left out; ids without their numbers."""
        path = self.folder / str(number)
        lines = path.read_text().splitlines() if path.exists() else []
        messages = [message for message in map(json.loads, lines) if "ping" not in message]
        return [
            {key: value.partition(" ")[2] if key in ("id", "forget") else value for key, value in one.items()}
            for one in messages
        ]

    @property
    def started(self) -> int:
        return len(list(self.folder.iterdir()))


@pytest.fixture
def run(tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Run]:
    manners, patience = request.param if isinstance(request.param, tuple) else (request.param, None)
    if patience is None:
        silent = manners.startswith(("mute", "hang"))
        patience = ENDLESS if not silent else PATIENT if manners.endswith("good") else QUICK
    run = Run(tmp_path, manners, patience)
    yield run
    run.observers.leave()
    run.until(lambda: not run.observers.alive)
    run.loop.close()


ODD = ["die", "mute", "hang", "garbage", "list", "nameless", "wordless", "factless", "endless"]


@pytest.mark.parametrize("run", [f"{manner},good" for manner in ODD], indirect=True)
def test_one_that_is_lost_is_replaced_and_gets_its_orders_again(run: Run) -> None:
    run.order("a", WATCH)
    run.order("b", CHANGE)
    run.until(lambda: len([word for word in run.words() if word[1] == "done"]) == 2)
    assert run.orders(1) == [{"id": "a", **WATCH, "again": True}, {"id": "b", **CHANGE, "again": True}]
    assert len(run.told) == 1
    assert run.told[0].endswith("; it is started again")


@pytest.mark.parametrize("run", [("mute,good", Patience(60.0, 60.0, 60.0, 60.0))], indirect=True)
def test_one_that_has_ended_when_it_gets_an_order_is_told_to_have_ended(run: Run) -> None:
    """Not that its pipe is broken, which may be found first; and the orders of both times are given to the next one."""
    before = set(proc.descendants(os.getpid()))
    run.order("a", WATCH)
    run.until(lambda: run.started)
    (pid,) = set(proc.descendants(os.getpid())) - before
    os.kill(pid, signal.SIGKILL)
    os.waitid(os.P_PID, pid, os.WEXITED | os.WNOWAIT)
    run.order("b", CHANGE)
    run.until(lambda: len([word for word in run.words() if word[1] == "done"]) == 2)
    assert len(run.told) == 1
    assert run.told[0].endswith("ended (SIGKILL); it is started again")


@pytest.mark.parametrize("run", ODD, indirect=True)
def test_where_the_next_one_is_lost_too_the_orders_fail(run: Run) -> None:
    run.order("a", WATCH)
    run.until(lambda: run.heard)
    assert run.words() == [("a", "impossible")]
    reason = run.heard[0]["reason"]
    assert reason.startswith("the observer, which looks into the ROS graph, ")
    assert reason.endswith(", and so did the one before")
    assert run.started == 2


@pytest.mark.parametrize("run", ["broken"], indirect=True)
def test_one_that_cannot_begin_is_not_started_again(run: Run) -> None:
    """What it said comes first."""
    run.order("a", WATCH)
    run.until(lambda: run.heard)
    assert run.told == ["no such module\n"]
    assert run.heard[0]["reason"] == (
        "the observer, which looks into the ROS graph, ended (exit code 1) before it had begun"
    )
    assert run.started == 1


@pytest.mark.parametrize("run", [("die", ENDLESS._replace(lasting=0.0))], indirect=True)
def test_one_that_is_lost_after_a_long_time_is_replaced_again(run: Run) -> None:
    run.order("a", WATCH)
    run.until(lambda: run.started > 3)
    assert run.heard == []


@pytest.mark.parametrize("run", ["ask,good"], indirect=True)
def test_a_component_that_may_have_been_loaded_is_not_loaded_again(run: Run) -> None:
    before = proc.children(os.getpid())
    run.order("a", LOAD)
    run.order("b", CHANGE)
    run.until(lambda: run.words() == [("a", "asking"), ("b", "asking")])
    (pid,) = set(proc.children(os.getpid())) - {*before}
    os.kill(pid, signal.SIGKILL)
    run.until(lambda: len(run.heard) == 5)
    assert run.words()[2:] == [("a", "impossible"), ("b", "asking"), ("b", "done")]
    assert run.heard[2]["reason"] == "the observer, which looks into the ROS graph, ended (SIGKILL)"
    assert [order["id"] for order in run.orders(1)] == ["b"]


@pytest.mark.parametrize("run", ["hang"], indirect=True)
def test_one_that_only_listens_is_not_asked_whether_it_is_there(run: Run) -> None:
    """Nothing is awaited, so nobody wakes up."""
    run.order("a", {"do": "transitions", "node": "/n"})
    run.order("b", {"do": "stay", "node": "/n"})
    run.until(lambda: len(run.orders(0)) == 2)
    assert run.loop._until_next_timer() is None
    run.order("c", WATCH)
    assert run.loop._until_next_timer() is not None


@pytest.mark.parametrize("run", ["mute,good"], indirect=True)
def test_one_with_nothing_to_do_leaves_and_the_next_order_starts_another(run: Run) -> None:
    run.order("a", WATCH)
    run.until(lambda: run.orders(0))
    run.observers.relieve()
    assert not run.observers.alive[0].leaving
    run.observers.forget("a")
    run.observers.relieve()
    run.order("b", WATCH)
    run.until(lambda: ("b", "done") in run.words())
    assert not [word for word in run.words() if word[0] == "a"]
    assert run.told == []


@pytest.mark.parametrize("run", ["good"], indirect=True)
def test_an_answer_to_an_earlier_order_of_the_same_name_is_none_to_this_one(run: Run) -> None:
    heard: list[dict[str, Any]] = []
    run.observers.order("a", WATCH, {**os.environ, "ROS_DOMAIN_ID": "1"}, heard.append)
    wait_for(lambda: run.orders(0), "the order")  # the answer is there, and we do not read it
    run.observers.forget("a")
    run.order("a", CHANGE)
    run.until(lambda: ("a", "done") in run.words())
    assert run.words() == [("a", "asking"), ("a", "done")]
    assert run.heard[1]["state"] == "active"
    assert heard == []


@pytest.mark.parametrize("run", ["mute"], indirect=True)
def test_at_the_end_only_what_nodes_are_asked_goes_on(run: Run) -> None:
    run.order("a", WATCH)
    run.order("r", {"do": "rate", "topic": "/t", "window": 1.0})
    run.order("b", CHANGE)
    run.observers.drop()
    run.order("w", WATCH)
    run.order("c", CHANGE)
    run.until(lambda: len(run.orders(0)) == 6)
    assert run.orders(0)[3:] == [{"forget": "a"}, {"forget": "r"}, {"id": "c", **CHANGE}]


def test_one_that_cannot_be_started_is_a_reason(tmp_path: Path) -> None:
    before = proc.descendants(os.getpid())
    loop, heard = Loop(), list[dict[str, Any]]()
    observers = Observers(loop, Kin(""), print, command=(str(tmp_path / "nothing"),))
    observers.order("a", WATCH, dict(os.environ), heard.append)
    assert [message["say"] for message in heard] == ["impossible"]
    assert heard[0]["reason"].startswith("the observer could not be started: ")
    assert proc.descendants(os.getpid()) == before
    loop.close()

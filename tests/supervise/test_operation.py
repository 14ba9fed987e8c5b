"""What an operator asks of a run, with real processes."""

from __future__ import annotations

import contextlib
import json
import os
import signal
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from orchestra.plan.reactions import TriggerEvent
from orchestra.supervise.options import RunOptions
from orchestra.supervise.resolver import document
from orchestra.values import Restart, Stop
from tests.supervise.plans import (
    after,
    launched,
    log,
    plan,
    process,
    ready_when,
    shutdown,
    wait_for,
    when,
    when_ended,
)

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from orchestra.plan.model import Plan
    from tests.supervise.plans import Launched

STEADY = ("polite", "say=up", "linger")


class Operated:
    def __init__(self, run: Launched, fifo: Path) -> None:
        self.run = run
        self.fifo = fifo
        self.asked = 0

    def ask(self, line: str) -> Any:
        with self.fifo.open("w") as pipe:
            pipe.write(line + "\n")
        self.asked += 1
        said = self.fifo.with_name("fifo.said")
        lines = wait_for(
            lambda: said.exists() and len(found := said.read_text().splitlines()) >= self.asked and found,
            line,
        )
        return json.loads(lines[self.asked - 1])


@contextlib.contextmanager
def operated(folder: Path, what: Plan) -> Iterator[Operated]:
    fifo = folder / "fifo"
    os.mkfifo(fifo)
    path = folder / "document.json"
    path.write_bytes(document.dumps(what, RunOptions()))
    with launched(folder, ("operated.py", str(path), str(fifo))) as run:
        yield Operated(run, fifo)


def test_a_restart_is_no_failure_and_sets_nothing_off(tmp_path: Path) -> None:
    """Not even where the process fails by being ended, must not end, and may not be started again."""
    fragile = process(
        "a", "polite=3", "say=up", "linger", required=True, restart=Restart("on-failure", budget=0)
    )
    triggers = (
        when_ended("a", shutdown("a has ended")),
        when(TriggerEvent("process_completed", "a"), log("completed")),
    )
    with operated(tmp_path, plan(fragile, triggers=triggers)) as operator:
        run = operator.run
        for count in (1, 2, 3):
            run.await_event("process_running", "a", count)
            run.await_line("a", "up", count)
            assert operator.ask("restart a") == {"a": None}
        run.await_event("process_running", "a", 4)
        assert not run.of_kind("trigger_fired")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert "a is restarted by an operator" in run.stderr
        assert "failed" not in run.stderr.rpartition("run ended")[2]


def test_what_is_stopped_stays_down_and_the_run_open(tmp_path: Path) -> None:
    always = process("a", *STEADY, restart=Restart("always"), required=True)
    with operated(tmp_path, plan(always)) as operator:
        run = operator.run
        run.await_line("a", "up")
        assert operator.ask("stop a") == {"a": None}
        run.await_event("process_exited", "a")
        assert operator.ask("stop a") == {"a": "it does not run"}
        assert operator.ask("ps") == [["a", "exited", 1, None]]
        assert operator.ask("signal USR1 a") == {"a": "it does not run"}
        assert operator.ask("start a") == {"a": None}
        run.await_event("process_running", "a", 2)
        assert operator.ask("start a") == {"a": "it runs already"}
        operator.ask("down enough")
        assert run.wait() == 0
        assert "run ended with status 0: enough" in run.stderr


def test_a_dependent_goes_on_waiting_for_what_was_stopped(tmp_path: Path) -> None:
    server = process("server", "say=starting", "linger", ready=ready_when(log="never"))
    client = process("client", *STEADY, depends_on=after("server", "ready"))
    with operated(tmp_path, plan(server, client)) as operator:
        run = operator.run
        run.await_line("server", "starting")
        assert operator.ask("ps")[1] == [
            "client", "waiting", 0, "server to be ready (a line of its output that matches 'never')"
        ]  # fmt: skip
        operator.ask("stop server")
        run.await_event("process_exited", "server")
        assert operator.ask("ps")[1][1] == "waiting"
        assert "waits for server to be ready" in operator.ask("restart client")["client"]
        assert operator.ask("start client") == {"client": None}
        run.await_line("client", "up")
        operator.ask("down enough")
        assert run.wait() == 0


def test_a_pause_ends_by_hand_and_a_stop_ends_a_storm(tmp_path: Path) -> None:
    crash = process("a", "exit=1", restart=Restart("always", delay=600.0, max_delay=600.0))
    with operated(tmp_path, plan(crash, process("b", *STEADY))) as operator:
        run = operator.run
        run.await_event("process_restarting", "a")
        assert operator.ask("start a") == {"a": None}
        run.await_event("process_restarting", "a", 2)
        assert operator.ask("restart a") == {"a": None}
        run.await_event("process_restarting", "a", 3)
        assert operator.ask("stop a") == {"a": None}
        assert operator.ask("ps")[0][:3] == ["a", "exited", 3]
        run.await_line("b", "up")
        run.send(signal.SIGTERM)
        assert run.wait() == 143


def test_a_stubborn_process_is_restarted_all_the_same(tmp_path: Path) -> None:
    stubborn = process("a", "ignore=INT,TERM", "say=up", "linger", stop=Stop(timeout=0.2, kill_timeout=0.2))
    with operated(tmp_path, plan(replace(stubborn))) as operator:
        run = operator.run
        run.await_line("a", "up")
        assert operator.ask("restart a") == {"a": None}
        assert operator.ask("start a") in ({"a": None}, {"a": "it runs already"})
        run.await_event("process_running", "a", 2)
        sent = [event.data["signal"] for event in run.of_kind("signal_sent", "a")]
        assert sent == ["SIGINT", "SIGTERM", "SIGKILL"]
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_signals_reach_the_process(tmp_path: Path) -> None:
    with operated(tmp_path, plan(process("a", *STEADY))) as operator:
        run = operator.run
        run.await_line("a", "up")
        assert operator.ask("signal TERM a") == {"a": None}
        run.await_event("process_exited", "a")
        assert run.wait() == 0

"""What sets triggers off, and what their actions do, with real processes."""

from __future__ import annotations

import signal
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan.reactions import (
    CancelAction,
    LogAction,
    RegisterAction,
    SignalAction,
    StopAction,
    TriggerEvent,
    UnregisterAction,
)
from orchestra.supervise.options import RunOptions
from orchestra.values import Restart, Stop
from tests.supervise.plans import (
    HERE,
    at_start,
    finished,
    launched,
    log,
    plan,
    process,
    shutdown,
    start,
    when,
    when_ended,
)

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.reactions import Trigger


def on(event: Any, *actions: Any, target: str | None = "a", **changes: Any) -> Trigger:
    return when(TriggerEvent(event, target), *actions, **changes)


def stop(*names: str) -> StopAction:
    return StopAction(names, HERE)


def told(stderr: str, *texts: str) -> list[str]:
    """Return those of the texts that were said, in the order in which they were."""
    lines = [line.removeprefix("[orchestra] ") for line in stderr.splitlines()]
    return [line for line in lines if line in texts]


@pytest.mark.conforms("4.8 ExecutionComplete")
def test_a_start_an_end_and_the_last_end_are_three_things(tmp_path: Path) -> None:
    triggers = (
        on("process_completed", log("completed")),
        on("process_exited", log("ended")),
        on("process_started", log("started")),
    )
    again = process("a", "exit=1", restart=Restart("always", budget=1))
    run = finished(tmp_path, plan(again, triggers=triggers))
    assert told(run.stderr, "started", "ended", "completed") == ["started", "ended"] * 2 + ["completed"]


@pytest.mark.conforms("D28", "7 11", "D69")
def test_a_program_that_cannot_be_started_is_an_end_with_a_reason(tmp_path: Path) -> None:
    triggers = (
        on("process_started", log("started")),
        on("process_exited", log("ended")),
        on("process_completed", log("completed")),
    )
    run = finished(tmp_path, plan(process("a", command=("/no/such/program",)), triggers=triggers))
    assert told(run.stderr, "started", "ended", "completed") == ["ended", "completed"]


@pytest.mark.conforms("7 6", "4.1 4")
def test_handlers_of_one_end_its_own_first_then_the_newest(tmp_path: Path) -> None:
    """The order that upstream has; output without an end of line comes before all of them."""
    triggers = (
        on("process_exited", log("second written")),
        on("process_exited", log("third written"), target=None),
        on("process_exited", log("its own"), identity="a:on_exit"),
        on("process_output", log("output")),
    )
    run = finished(tmp_path, plan(process("a", "partial=nonl", "exit=0"), triggers=triggers))
    said = ("output", "its own", "third written", "second written")
    assert told(run.stderr, *said) == list(said)
    assert run.log("a") == "nonl"


@pytest.mark.parametrize(
    ("stream", "seen"), [("stdout", ["on stdout"]), ("stderr", ["on stderr"]), (None, ["on both", "on both"])]
)
def test_output_sets_off_by_stream(tmp_path: Path, stream: Any, seen: list[str]) -> None:
    text = f"on {stream or 'both'}"
    triggers = (when(TriggerEvent("process_output", "a", stream=stream), log(text)),)
    run = finished(
        tmp_path, plan(process("a", "say=x", "complain=y"), process("b", "say=z"), triggers=triggers)
    )
    assert told(run.stderr, text) == seen


@pytest.mark.conforms("1.7 handle_once", "1.3 UnregisterEventHandler")
def test_once_is_once_and_unregistered_is_never(tmp_path: Path) -> None:
    triggers = (
        on("process_exited", log("once"), once=True),
        on("process_exited", log("never"), identity="never"),
        on("process_exited", log("always")),
        on("process_started", UnregisterAction("never", HERE)),
    )
    again = process("a", "exit=1", restart=Restart("always", budget=2))
    run = finished(tmp_path, plan(again, triggers=triggers))
    assert told(run.stderr, "once", "never", "always").count("always") == 3
    assert told(run.stderr, "once", "never") == ["once"]


def test_a_trigger_waits_from_its_registration_on(tmp_path: Path) -> None:
    triggers = (
        on("process_exited", log("seen"), target=None, identity="late", armed=False),
        on("process_exited", RegisterAction("late", HERE), start("b")),
    )
    run = finished(tmp_path, plan(process("a", "exit=0"), process("b", "exit=0"), triggers=triggers))
    assert told(run.stderr, "seen") == ["seen"]


@pytest.mark.conforms("1.6 process.ShutdownProcess")
def test_a_stop_ends_that_process_alone_and_nothing_restarts_it(tmp_path: Path) -> None:
    """With its own ladder: it ignores the first step."""
    stubborn = process(
        "a",
        "ignore=INT",
        "say=up",
        "linger",
        restart=Restart("always"),
        stop=Stop("SIGINT", timeout=0.2, kill_timeout=5.0),
    )
    triggers = (on("process_output", stop("a")), on("process_completed", log("over")))
    with launched(tmp_path, plan(stubborn, process("b", "linger"), triggers=triggers)) as run:
        run.await_event("process_exited", "a")
        assert run.of_kind("process_ended", "a")[0].data["signal"] == signal.SIGTERM
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.kinds("a").count("process_starting") == 1
        assert told(run.stderr, "over") == ["over"]
        assert "failed:" not in run.stderr


def test_a_stopped_process_may_be_started_again(tmp_path: Path) -> None:
    triggers = (
        at_start(start("a")),
        on("process_output", stop("a"), once=True),
        on("process_completed", start("a"), once=True),
    )
    with launched(tmp_path, plan(process("a", "say=up", "linger"), triggers=triggers)) as run:
        run.await_event("process_running", "a", count=2)
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_start_of_what_runs_is_said_and_not_done(tmp_path: Path) -> None:
    triggers = (
        at_start(start("a")),
        on("process_started", start("a")),
        on("process_output", shutdown("x"), delay=0.2),
    )
    run = finished(tmp_path, plan(process("a", "say=up", "linger"), triggers=triggers))
    assert "a is not started by a trigger: it has not ended" in run.stderr
    assert run.kinds("a").count("process_starting") == 1


@pytest.mark.conforms("1.6 process.SignalProcess")
@pytest.mark.parametrize(("name", "ended_by"), [("SIGUSR1", signal.SIGUSR1), ("SIGKILL", signal.SIGKILL)])
def test_a_signal_reaches_the_program(tmp_path: Path, name: str, ended_by: int) -> None:
    triggers = (on("process_output", SignalAction(("a",), name, HERE)),)
    run = finished(tmp_path, plan(process("a", "say=up", "linger"), triggers=triggers))
    assert run.of_kind("process_ended", "a")[0].data["signal"] == ended_by
    assert [event.data["signal"] for event in run.of_kind("signal_sent", "a")] == [name]


@pytest.mark.conforms("1.7 OnShutdown", "4.9 7")
def test_a_shutdown_sets_off_its_triggers_and_starts_nothing(tmp_path: Path) -> None:
    triggers = (
        on("shutdown", log("going down"), start("late"), stop("a"), target=None),
        on("process_exited", log("a is over")),
        at_start(shutdown("enough"), delay=0.1),
    )
    run = finished(tmp_path, plan(process("a", "linger"), process("late", "linger"), triggers=triggers))
    assert run.popen.returncode == 0
    assert told(run.stderr, "going down", "a is over") == ["going down", "a is over"]
    assert "late is not started: the run is ending" in run.stderr
    assert not run.of_kind("process_starting", "late")


@pytest.mark.conforms("1.3 TimerAction", "4.9 8")
def test_delays_are_dropped_at_the_end_unless_they_say_otherwise(tmp_path: Path) -> None:
    began = TriggerEvent("run_started")
    triggers = (
        when(began, log("dropped"), delay=1.0),
        when(began, log("kept"), delay=1.0, cancel_on_shutdown=False),
        when(began, log("too late"), delay=60.0, cancel_on_shutdown=False),
        when(began, shutdown("now"), delay=0.3),
    )
    run = finished(tmp_path, plan(process("a", "linger"), triggers=triggers))
    assert told(run.stderr, "dropped", "kept", "too late") == ["kept"]
    assert "dropped: it would come later than 3 s after the end" in run.stderr


def test_what_is_cancelled_waits_no_more_and_its_delay_is_dropped(tmp_path: Path) -> None:
    began = TriggerEvent("run_started")
    triggers = (
        replace(when(began, log("delayed"), delay=60.0, cancel_on_shutdown=False), id="delayed"),
        on("process_exited", log("never"), identity="never"),
        on("process_started", CancelAction("delayed", HERE), CancelAction("never", HERE)),
        on("process_exited", CancelAction("delayed", HERE)),
    )
    run = finished(tmp_path, plan(process("a", "exit=0"), triggers=triggers))
    assert told(run.stderr, "delayed", "never") == []


@pytest.mark.parametrize(("debug", "seen"), [(True, True), (False, False)])
def test_levels_of_messages(tmp_path: Path, debug: bool, seen: bool) -> None:
    triggers = (
        at_start(
            LogAction("fine", HERE, "debug"),
            LogAction("odd", HERE, "warning"),
            LogAction("bad", HERE, "error"),
        ),
    )
    run = finished(tmp_path, plan(process("a", "exit=0"), triggers=triggers), RunOptions(debug=debug))
    assert told(run.stderr, "warning: odd", "error: bad") == ["warning: odd", "error: bad"]
    assert ("fine" in run.stderr) == seen
    assert "fine" in run.log("all")


def test_actions_of_a_trigger_come_in_order(tmp_path: Path) -> None:
    texts = [f"step {number}" for number in range(5)]
    run = finished(tmp_path, plan(process("a", "exit=0"), triggers=(when_ended("a", *map(log, texts)),)))
    assert told(run.stderr, *texts) == texts

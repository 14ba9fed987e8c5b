"""Triggers that only code of the description decides, with a resolver that stays."""

from __future__ import annotations

import base64
import json
import os
import signal
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan import codec
from orchestra.plan.reactions import TriggerEvent
from orchestra.supervise.options import RunOptions
from tests.supervise.plans import (
    at_start,
    deferred,
    launched,
    log,
    name_of,
    plan,
    process,
    ready_when,
    shutdown,
    start,
    when,
    when_ended,
)

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from orchestra.plan.model import Plan
    from tests.supervise.plans import Launched


@dataclass
class Decided:
    """A run whose resolver answers by a table, and what it was asked."""

    folder: Path
    answers: dict[int, dict[str, Any]]

    def launched(self, what: Plan, options: RunOptions | None = None) -> AbstractContextManager[Launched]:
        path = self.folder / "answers.json"
        path.write_text(json.dumps(self.answers))
        return launched(self.folder, what, options or RunOptions(), answers=path)

    def finished(self, what: Plan, options: RunOptions | None = None) -> Launched:
        with self.launched(what, options) as run:
            run.wait()
            assert not run.everything()
            return run

    @property
    def asked(self) -> list[dict[str, Any]]:
        path = self.folder / "answers.asked"
        return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def fragment(**records: Any) -> dict[str, Any]:
    return {"answer": {name: codec.encode(value) for name, value in records.items()}}


@pytest.fixture
def decided(tmp_path: Path) -> Decided:
    return Decided(tmp_path, {})


def test_an_answer_becomes_part_of_the_plan(decided: Decided) -> None:
    new = process(
        "/ns/new",
        command=("/bin/cat", "${run}/params/ns.new.yaml"),
        name="new",
        namespace="/ns",
        parameters={"rate": 2.0},
    )
    decided.answers[1] = fragment(
        processes=[new],
        triggers=[when_ended("/ns/new", log("new is over"), identity="n1")],
        do=[log("at once")],
    )
    what = plan(process("a", "exit=3"), triggers=(when_ended("a", deferred(1), log("afterwards")),))
    run = decided.finished(what)
    assert run.popen.returncode == 0, run.stderr
    (question,) = decided.asked
    assert question["ref"] == 1
    assert (question["event"]["event"], question["event"]["process"]) == ("process_exited", "a")
    assert question["event"]["returncode"] == 3
    assert isinstance(question["event"]["pid"], int)
    assert "rate: 2.0" in run.log("ns.new")
    (revision,) = run.of_kind("plan_revised")
    assert [item["id"] for item in revision.data["processes"]] == ["/ns/new"]
    lines = [
        line
        for line in run.stderr.splitlines()
        if line.split("] ")[1] in ("at once", "afterwards", "new is over")
    ]
    assert [line.split("] ")[1] for line in lines] == ["at once", "afterwards", "new is over"]


def test_an_answer_may_start_later_and_defer_again(decided: Decided) -> None:
    decided.answers[1] = fragment(
        processes=[process("b", "exit=0"), process("c", "exit=0")],
        triggers=[when_ended("b", deferred(2), identity="n1")],
        do=[start("b")],
    )
    decided.answers[2] = fragment(do=[start("c"), log("second answer")])
    # c stands in no `start` of the first answer, so it begins at once; the second answer starts it once more.
    run = decided.finished(plan(process("a", "exit=0"), triggers=(when_ended("a", deferred(1)),)))
    assert run.popen.returncode == 0, run.stderr
    assert run.kinds("b").count("process_starting") == 1
    assert "second answer" in run.stderr


@pytest.mark.conforms("1.6 process.ProcessIO")
def test_output_is_handed_over_as_it_came(decided: Decided) -> None:
    decided.answers[1] = fragment(do=[log("heard @TEXT@")])
    trigger = when(TriggerEvent("process_output", "a", stream="stderr"), deferred(1))
    run = decided.finished(plan(process("a", "say=no", "complain=é!"), triggers=(trigger,)))
    (question,) = decided.asked
    assert question["event"]["stream"] == "stderr"
    assert base64.b64decode(question["event"]["text"]) == "é!\n".encode()
    assert "heard é!" in run.stderr


def test_a_shutdown_handler_is_asked_and_may_only_tell(decided: Decided) -> None:
    decided.answers[1] = fragment(processes=[process("b", "linger")], do=[start("b"), log("a last word")])
    what = plan(process("a", "linger"), triggers=(when(TriggerEvent("shutdown"), deferred(1)),))
    with decided.launched(what) as run:
        run.await_event("process_running", "a")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert decided.asked[0]["event"] == {"event": "shutdown", "reason": "SIGINT", "due_to_sigint": True}
        assert "a last word" in run.stderr
        assert "b is not started: the run is ending" in run.stderr
        assert not run.kinds("b")


@pytest.mark.parametrize(
    ("answer", "told"),
    [
        ({"raise": "no idea"}, "by_hand.yaml:7:1: this trigger failed: RuntimeError: no idea"),
        ({"exit": 5}, "by_hand.yaml:7:1: this trigger failed: SystemExit: 5"),
        ({"die": "KILL"}, "by_hand.yaml:7:1: this trigger failed: the resolver, which runs the code"),
        ({"answer": {"nonsense": []}}, "by_hand.yaml:7:1: this trigger failed: this is a bug in Orchestra"),
        (
            {"answer": {"do": [{"action": "fly"}]}},
            "by_hand.yaml:7:1: this trigger failed: this is a bug in Orchestra",
        ),
        ({"answer": []}, "by_hand.yaml:7:1: this trigger failed: this is a bug in Orchestra"),
        (
            {"answer": {"failure": "it is so", "location": codec.encode(deferred(0, 3).location)}},
            "by_hand.yaml:3:1: this trigger failed: it is so",
        ),
        (fragment(processes=[process("a", "exit=0")]), "there are two process records a"),
        (fragment(do=[start("nobody")]), "there is no process nobody"),
        (fragment(triggers=[when_ended("nobody", log("x"), identity="n")]), "there is no node nobody"),
    ],
)
def test_a_trigger_that_fails_ends_the_run_with_its_place(
    decided: Decided, answer: dict[str, Any], told: str
) -> None:
    decided.answers[1] = answer
    run = decided.finished(plan(process("a", "linger"), triggers=(at_start(deferred(1, 7)),)))
    assert run.popen.returncode == 1
    assert told in run.stderr
    assert run.stderr.splitlines()[-1].startswith("[orchestra] run ended with status 1: by_hand.yaml:")


def test_code_that_hangs_is_given_up_in_time(decided: Decided) -> None:
    decided.answers[1] = {"hang": 0}
    what = plan(process("a", "linger"), triggers=(at_start(deferred(1)),))
    run = decided.finished(what, RunOptions(resolver_timeout=1.0))
    assert run.popen.returncode == 1
    assert "the code of the launch file did not answer within 1 s" in run.stderr


def test_a_stop_signal_ends_the_wait_for_code_that_hangs(decided: Decided) -> None:
    decided.answers[1] = {"hang": 0}
    what = plan(
        process("a", "linger"), triggers=(at_start(deferred(1)), when(TriggerEvent("shutdown"), deferred(1)))
    )
    with decided.launched(what) as run:
        run._await(lambda: "hanging" in run.stderr, "the question")
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.ending < 6.0
        assert "this trigger is given up: the run ended before the answer" in run.stderr
        run.assert_gone()


@pytest.mark.conforms("D36")
def test_code_that_hangs_holds_up_no_process(decided: Decided) -> None:
    """Neither those that write nor those that start: only the handler itself waits."""
    decided.answers[1] = {"hang": 0}
    talker = process("a", "bytes=12000000", "say=done", "linger", ready=ready_when("done"))
    trigger = when(TriggerEvent("process_output", "a"), deferred(1))
    with decided.launched(plan(talker, triggers=(trigger,))) as run:
        run.await_event("process_ready", "a")
        assert run.stderr.count("output comes faster than this handler takes it") == 1
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_resolver_that_nobody_needs_ends_before_the_run_begins(decided: Decided) -> None:
    what = plan(process("a", "linger"), triggers=(at_start(log("x")),))
    with decided.launched(what) as run:
        run.await_event("process_running", "a")
        assert "orc-resolver" not in {name_of(pid) for pid in run.everything()}


def test_a_killed_resolver_fails_the_next_question_and_nothing_else(decided: Decided) -> None:
    decided.answers[1] = fragment()
    what = plan(
        process("a", "linger"),
        process("b", "exit=0"),
        triggers=(when_ended("b", deferred(1)), when_ended("a", deferred(1, 9))),
    )
    with decided.launched(what) as run:
        run.await_event("plan_revised")
        os.kill(run.own("orc-resolver"), signal.SIGKILL)
        pid = run.of_kind("process_running", "a")[0].pid
        assert pid
        os.kill(pid, signal.SIGKILL)
        assert run.wait() == 1
        assert "by_hand.yaml:9:1: this trigger failed: the resolver" in run.stderr
        run.assert_gone()


@pytest.mark.parametrize("victim", ["orc-keeper", "orc-supervisor"])
def test_nothing_is_left_whoever_is_killed_while_the_resolver_stays(decided: Decided, victim: str) -> None:
    decided.answers[1] = {"hang": 0}
    what = plan(process("a", "linger"), triggers=(at_start(deferred(1)),))
    with decided.launched(what) as run:
        run._await(lambda: "hanging" in run.stderr, "the question")
        os.kill(run.own(victim), signal.SIGKILL)
        run.assert_gone()


def test_answers_of_one_event_keep_the_order_of_its_handlers(decided: Decided) -> None:
    """A slow one holds up those after it for the same event, and no other event."""
    go = decided.folder / "go"
    decided.answers[1] = {"slow": str(go)}
    what = plan(
        process("a", "exit=0"),
        process("b", "exit=0"),
        triggers=(
            when_ended("a", log("older handler")),
            when_ended("a", deferred(1)),
            when_ended("b", log("b is over")),
        ),
    )
    with decided.launched(what) as run:
        run._await(lambda: decided.asked, "the question")
        run._await(lambda: "b is over" in run.stderr, "the other event")
        go.touch()
        assert run.wait() == 0
    texts = [line.split("] ")[1] for line in run.stderr.splitlines()]
    assert texts.index("b is over") < texts.index("older handler")


def test_a_failure_while_the_run_ends_is_named_at_the_end(decided: Decided) -> None:
    decided.answers[1] = {"raise": "too late"}
    what = plan(
        process("a", "linger"),
        triggers=(when(TriggerEvent("shutdown"), deferred(1, 5)), at_start(shutdown("enough"), delay=0.1)),
    )
    run = decided.finished(what)
    assert run.popen.returncode == 0
    assert run.stderr.splitlines()[-1].endswith(
        "by_hand.yaml:5:1: this trigger failed: RuntimeError: too late"
    )

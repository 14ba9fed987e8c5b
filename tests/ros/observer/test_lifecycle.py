"""Lifecycle nodes of a run, with real ones."""

from __future__ import annotations

import os
import signal
import sys
import time
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan.reactions import ChangeStateAction, TriggerEvent
from orchestra.supervise.options import RunOptions
from orchestra.supervise.process.life import QUIESCE_WITHIN
from orchestra.values import Restart, Stop
from tests.ros.observer.conversation import Domain, observing
from tests.supervise.plans import (
    HERE,
    PROCESSES,
    after,
    finished,
    launched,
    log,
    plan,
    process,
    shutdown,
    wait_for,
    when,
    when_ended,
)
from tests.supervise.test_operation import operated

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process
    from orchestra.plan.reactions import Trigger

DOMAIN = {"ROS_DOMAIN_ID": "32", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
CONFIGURE, ACTIVATE, DEACTIVATE = 1, 3, 4


# Time to deactivate, on a machine that has much else to do.
PATIENT = Stop(timeout=30.0)


def node(*words: str, name: str = "managed", **changes: Any) -> Process:
    command = (sys.executable, str(PROCESSES / "lifecycle_node.py"), name, *words)
    fields = {"kind": "lifecycle_node", "name": name, "namespace": "/", "command": command}
    return process(f"/{name}", **{**fields, "stop": PATIENT, **changes})


def change(*transitions: int, target: str = "/managed") -> ChangeStateAction:
    return ChangeStateAction((target,), transitions, HERE)


def when_state(goal: str, *actions: Any, **changes: Any) -> Trigger:
    return when(TriggerEvent("state_changed", "/managed", goal_state=goal), *actions, **changes)


def at_start(*actions: Any) -> Trigger:
    return when(TriggerEvent("run_started"), *actions)


@pytest.mark.conforms("4.11 autostart", "D40")
def test_a_node_is_brought_to_active(tmp_path: Path) -> None:
    triggers = (when_state("active", shutdown("it is active")),)
    run = finished(tmp_path, plan(node(lifecycle="active"), triggers=triggers), environment=DOMAIN)
    assert run.popen.returncode == 0, run.stderr
    assert run.log("managed").splitlines()[:3] == ["up", "configure", "activate"]
    moves = [
        (e.data["start_state"], e.data["goal_state"], e.data["transition"])
        for e in run.of_kind("state_changed")
    ]
    assert moves == [
        ("unconfigured", "configuring", "configure"),
        ("configuring", "inactive", "transition_success"),
        ("inactive", "activating", "activate"),
        ("activating", "active", "transition_success"),
    ]
    assert "shut down: it is active" in run.stderr


@pytest.mark.conforms("4.11 usual pattern", "4.11 state changes", "4.11 LifecycleNode")
def test_the_usual_pattern_configure_then_activate_on_inactive(tmp_path: Path) -> None:
    """The order to configure stands before the process that it is for has been started."""
    triggers = (
        at_start(change(CONFIGURE)),
        when(
            TriggerEvent("state_changed", "/managed", start_state="configuring", goal_state="inactive"),
            change(ACTIVATE),
        ),
        when_state("active", change(DEACTIVATE), once=True),
        when(
            TriggerEvent("state_changed", None, start_state="deactivating", goal_state="inactive"),
            shutdown("done"),
        ),
    )
    run = finished(tmp_path, plan(node(), triggers=triggers), environment=DOMAIN)
    assert run.popen.returncode == 0, run.stderr
    assert [e.data["state"] for e in run.of_kind("transition_done")][:2] == ["inactive", "active"]


@pytest.mark.conforms("4.11 LifecycleTransition")
def test_transitions_of_one_order_follow_each_other(tmp_path: Path) -> None:
    triggers = (at_start(change(CONFIGURE, ACTIVATE, DEACTIVATE)),)
    with launched(tmp_path, plan(node(), triggers=triggers), environment=DOMAIN) as run:
        run.await_event("transition_done", "/managed", count=3)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert [e.data["state"] for e in run.of_kind("transition_done")] == ["inactive", "active", "inactive"]


@pytest.mark.conforms("4.11 LifecycleTransition", "4.11 ChangeState")
def test_a_transition_that_fails_ends_its_order_and_is_told(tmp_path: Path) -> None:
    with launched(tmp_path, plan(node("fail=configure", lifecycle="active")), environment=DOMAIN) as run:
        event = run.await_event("transition_failed", "/managed")
        assert event.data["reason"] == "the node refused it, or failed, and is still unconfigured"
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert "activate" not in run.log("managed")
        assert "error: managed did not configure: the node refused it" in run.stderr
        assert run.stderr.splitlines()[-1].endswith(
            "managed did not configure: the node refused it, or failed, and is still unconfigured"
        )


def test_an_error_that_a_node_has_handled_is_told_from_a_refusal(tmp_path: Path) -> None:
    with launched(tmp_path, plan(node("error=configure", lifecycle="active")), environment=DOMAIN) as run:
        event = run.await_event("transition_failed", "/managed")
        assert event.data["reason"].startswith("an error ended the transition, the node has handled it")
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_transition_that_makes_no_sense_is_told(tmp_path: Path) -> None:
    triggers = (at_start(change(ACTIVATE)),)
    with launched(tmp_path, plan(node(), triggers=triggers), environment=DOMAIN) as run:
        event = run.await_event("transition_failed", "/managed")
        assert event.data["transition"] == "activate"
        run.send(signal.SIGINT)
        run.wait()


def test_a_node_that_dies_meanwhile_ends_the_order(tmp_path: Path) -> None:
    run = finished(tmp_path, plan(node("die=configure", lifecycle="active")), environment=DOMAIN)
    (event,) = run.of_kind("transition_failed")
    assert event.data["reason"] == "managed has ended (exit code 7)"
    assert "managed did not configure: managed has ended (exit code 7)" in run.stderr.splitlines()[-1]


def test_a_node_that_starts_again_is_brought_to_active_again(tmp_path: Path) -> None:
    again = node("die=activate", lifecycle="active", restart=Restart("always", budget=1))
    run = finished(tmp_path, plan(again), environment=DOMAIN)
    assert [e.data["state"] for e in run.of_kind("transition_done")] == ["inactive", "inactive"]
    assert len(run.of_kind("transition_failed")) == 2


@pytest.mark.conforms("4.11 ChangeState")
def test_a_service_that_never_appears_is_an_error_with_a_cause(tmp_path: Path) -> None:
    options = RunOptions(service_timeout=2.0, fail_on_any=True)
    silent = node("silent", lifecycle="active")
    with launched(tmp_path, plan(silent), options, environment=DOMAIN) as run:
        event = run.await_event("transition_failed", "/managed")
        assert event.data["reason"] == "there was no service /managed/change_state within 2 s"
        run.send(signal.SIGTERM)
        assert run.wait() == 143


@pytest.mark.conforms("D41")
def test_a_node_that_hangs_is_an_error_and_holds_up_nobody(tmp_path: Path) -> None:
    options = RunOptions(answer_timeout=4.0)
    both = (node("hang=configure", lifecycle="active"), node(name="other", lifecycle="active"))
    with launched(tmp_path, plan(*both), options, environment=DOMAIN) as run:
        run.await_event("transition_done", "/other", count=2)
        event = run.await_event("transition_failed", "/managed")
        assert event.data["reason"] == "/managed/change_state did not answer within 4 s"
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_an_order_for_a_node_that_will_not_come_fails(tmp_path: Path) -> None:
    nobody = node(command=("/no/such/program",))
    triggers = (at_start(change(CONFIGURE)), when_ended("/managed", log("it is over")))
    run = finished(tmp_path, plan(nobody, triggers=triggers), environment=DOMAIN)
    assert run.popen.returncode == 0, run.stderr
    (event,) = run.of_kind("transition_failed")
    assert "could not be started" in event.data["reason"]
    assert "it is over" in run.stderr


def test_a_node_is_deactivated_before_it_is_ended(tmp_path: Path) -> None:
    """The observer has stayed for it, alone, and is gone at the end."""
    with launched(tmp_path, plan(node(lifecycle="active")), environment=DOMAIN) as run:
        run.await_event("transition_done", "/managed", count=2)
        run.send(signal.SIGTERM)
        assert run.wait() == 143
        assert run.log("managed").splitlines() == ["up", "configure", "activate", "deactivate"]
        (left,) = run.of_kind("transition_done", "/managed")[2:]
        assert left.data == {"transition": "deactivate", "state": "inactive"}
        assert "error" not in run.stderr
        assert not run.everything()


def test_levels_are_deactivated_one_after_the_other(tmp_path: Path) -> None:
    """What depends on a node leaves its work before that node does."""
    server = node(name="server", lifecycle="active")
    client = node(name="client", lifecycle="active", depends_on=after("/server", "started"))
    with launched(tmp_path, plan(server, client), environment=DOMAIN) as run:
        for name in ("/server", "/client"):
            run.await_event("transition_done", name, count=2)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        steps = [
            (event.kind, event.process)
            for event in run.events
            if event.kind == "process_ended" or event.data.get("transition") == "deactivate"
        ]
        assert steps == [
            ("transition_done", "/client"),
            ("process_ended", "/client"),
            ("transition_done", "/server"),
            ("process_ended", "/server"),
        ]


def test_nodes_that_do_not_deactivate_are_ended_all_the_same(tmp_path: Path) -> None:
    reasons = {
        "fail": "the node refused it, or failed, and is still active",
        "error": "it failed; the node was active and is unconfigured: it has handled an error (`on_error`)",
        "die": "it ended before",
        "hang": "it ended before",
    }
    stops = {**dict.fromkeys(reasons, PATIENT), "hang": None}
    nodes = [
        node(f"{manner}=deactivate", name=manner, lifecycle="active", stop=stop)
        for manner, stop in stops.items()
    ]
    with launched(tmp_path, plan(*nodes), environment=DOMAIN) as run:
        for manner in reasons:
            run.await_event("transition_done", f"/{manner}", count=2)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        for manner, reason in reasons.items():
            if stops[manner]:  # else, on a busy machine, its time was over before it was asked
                assert run.log(manner).splitlines()[-1] == "deactivate"
            (event,) = run.of_kind("transition_failed", f"/{manner}")
            assert event.data["transition"] == "deactivate"
            assert event.data["reason"].startswith(reason)
            assert f"{manner} did not deactivate: {reason}" in run.stderr
        assert not run.everything()


@pytest.mark.parametrize("manner", ["unheard", "unanswered"])
def test_what_is_lost_on_the_way_is_asked_again(tmp_path: Path, manner: str) -> None:
    """Whether it was the request or the answer, each transition is made once."""
    words = [f"{manner}={transition}" for transition in ("configure", "activate", "deactivate")]
    with launched(tmp_path, plan(node(*words, lifecycle="active")), environment=DOMAIN) as run:
        run.await_event("transition_done", "/managed", count=2)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.log("managed").splitlines() == ["up", "configure", "activate", "deactivate"]
        assert [event.data["state"] for event in run.of_kind("transition_done")] == [
            "inactive",
            "active",
            "inactive",
        ]


def test_more_time_to_end_is_more_time_to_deactivate(tmp_path: Path) -> None:
    """Whoever would deactivate it is held up for longer than that may take where nothing is said."""
    with launched(tmp_path, plan(node(lifecycle="active")), environment=DOMAIN) as run:
        run.await_event("transition_done", "/managed", count=2)
        observer = run.own("orc-observer")
        os.kill(observer, signal.SIGSTOP)
        run.send(signal.SIGINT)
        begin = run.await_event("process_stopping", "/managed").monotonic
        wait_for(lambda: time.monotonic() > begin + QUIESCE_WITHIN + 0.2, "more than the usual time")
        os.kill(observer, signal.SIGCONT)
        assert run.wait() == 130
        assert run.log("managed").splitlines() == ["up", "configure", "activate", "deactivate"]


def test_a_node_that_was_deactivated_by_somebody_else_is_left_alone(tmp_path: Path) -> None:
    with launched(tmp_path, plan(node(lifecycle="active")), environment=DOMAIN) as run:
        run.await_event("transition_done", "/managed", count=2)
        with observing(Domain(int(DOMAIN["ROS_DOMAIN_ID"]), tmp_path)) as somebody:
            somebody.ask("down", "change_state", node="/managed", transition=DEACTIVATE)
            somebody.said("down", "done")
            run.send(signal.SIGINT)
            assert run.wait() == 130
        assert run.log("managed").splitlines() == ["up", "configure", "activate", "deactivate"]
        assert run.of_kind("transition_done")[-1].data["state"] == "inactive"


def test_a_node_that_crashes_is_brought_to_active_again_although_its_ghost_is_there(tmp_path: Path) -> None:
    """The observer that stayed still sees the one that was killed."""
    again = node(lifecycle="active", restart=Restart("on-failure"))
    with launched(tmp_path, plan(again), environment=DOMAIN) as run:
        run.await_event("transition_done", "/managed", count=2)
        pid = run.of_kind("process_running", "/managed")[0].pid
        assert pid is not None
        os.kill(pid, signal.SIGKILL)
        states = [run.await_event("transition_done", "/managed", count=3 + n).data["state"] for n in (0, 1)]
        assert states == ["inactive", "active"]
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert run.log("managed").splitlines() == [*["up", "configure", "activate"] * 2, "deactivate"]


def test_an_observer_that_is_killed_is_replaced_and_deactivates_the_node(tmp_path: Path) -> None:
    with launched(tmp_path, plan(node(lifecycle="active")), environment=DOMAIN) as run:
        run.await_event("transition_done", "/managed", count=2)
        first = run.own("orc-observer")
        os.kill(first, signal.SIGKILL)
        wait_for(lambda: run.own("orc-observer") != first, "another observer")
        told = "observer: ended (SIGKILL); it is started again"
        wait_for(lambda: told in run.stderr, told)
        # Whether it knows the node already or not: this is a defined end.
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert not run.everything()


def test_an_operator_who_stops_or_restarts_a_node_has_it_deactivated_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each new run of it is brought to active again."""
    for name, value in DOMAIN.items():
        monkeypatch.setenv(name, value)
    with operated(tmp_path, plan(node(lifecycle="active"))) as operator:
        run = operator.run
        for count, request in enumerate(("restart", "stop", "start"), 1):
            if request != "start":
                run.await_event("transition_done", "/managed", count=3 * count - 1)
            assert operator.ask(f"{request} /managed") == {"/managed": None}
            if request == "stop":
                run.await_event("process_exited", "/managed")
        run.await_event("transition_done", "/managed", count=8)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        states = [event.data["state"] for event in run.of_kind("transition_done")]
        assert states == ["inactive", "active", "inactive"] * 3
        assert not run.of_kind("transition_failed")

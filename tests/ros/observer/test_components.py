"""Components of a run, loaded into a real container."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.plan.model import Component, Provenance
from orchestra.plan.reactions import ChangeStateAction, LoadAction, TriggerEvent
from orchestra.supervise.options import RunOptions
from orchestra.values import Restart, Stop
from tests.killing import let_nobody_hang
from tests.supervise.plans import HERE, PROCESSES, finished, launched, plan, process, shutdown, wait_for, when

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Process
    from orchestra.plan.reactions import Trigger
    from tests.supervise.plans import Launched

DOMAIN = {"ROS_DOMAIN_ID": "35", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
NAME = "/ns/box"


def container(*words: str, **changes: Any) -> Process:
    command = (sys.executable, str(PROCESSES / "container.py"), NAME, *words)
    return process(
        NAME, **{"kind": "container", "name": "box", "namespace": "/ns", "command": command, **changes}
    )


def component(name: str, /, **changes: Any) -> Component:
    fields: dict[str, Any] = {
        "id": f"/{name}",
        "name": name,
        "namespace": "/",
        "package": "demo",
        "plugin": f"demo::{name.capitalize()}",
        "container": NAME,
        "process": NAME,
        "condition": "started",
        "parameters": {},
        "remappings": (),
        "extra_arguments": {},
        "lifecycle": None,
        "location": HERE,
        "provenance": Provenance(),
    }
    return Component(**{**fields, **changes})


def at_start(*actions: Any, **changes: Any) -> Trigger:
    return when(TriggerEvent("run_started"), *actions, **changes)


def requests(run: Launched) -> list[dict[str, Any]]:
    """What the container was asked to load; rclpy warns beside it of answers to a greeting that came too early."""
    return [json.loads(line) for line in run.log("ns.box").splitlines() if line.startswith("{")]


def stop(run: Launched) -> str:
    """End the run and return its last line."""
    run.send(signal.SIGINT)
    assert run.wait() == 130
    return run.stderr.splitlines()[-1]


@pytest.mark.conforms("4.7 service", "4.7 order", "4.7 request", "4.7 extra_arguments", "4.7 parameters")
def test_components_are_loaded_in_order_with_all_that_belongs_to_them(tmp_path: Path) -> None:
    parameters = {
        "a.b": 1,
        "rate": 2.0,
        "on": True,
        "text": "é",
        "file": "${run}/x",
        "ints": (1, 2),
        "floats": (1.0, 0.5),
        "flags": (True, False),
        "texts": ("a", ""),
    }
    first = component(
        "first",
        namespace="/deep/ns",
        parameters=parameters,
        remappings=(("scan", "/laser"), ("a", "b")),
        extra_arguments={"use_intra_process_comms": True},
    )
    nameless = component("third", name=None, namespace=None, plugin="Third")
    what = plan(container(), components=(first, component("second"), nameless))
    with launched(tmp_path, what, environment=DOMAIN) as run:
        assert run.await_event("component_loaded", "/third").data["node"] == "/third"
        first_request, *others = requests(run)
        assert first_request == {
            "package_name": "demo",
            "plugin_name": "demo::First",
            "node_name": "first",
            "node_namespace": "/deep/ns",
            "log_level": 0,
            "remap_rules": ["scan:=/laser", "a:=b"],
            "parameters": {
                **{
                    name: list(value) if isinstance(value, tuple) else value
                    for name, value in parameters.items()
                },
                "file": f"{run.directory}/x",
            },
            "extra_arguments": {"use_intra_process_comms": True},
        }
        assert [(item["plugin_name"], item["node_name"]) for item in others] == [
            ("demo::Second", "second"),
            ("Third", ""),
        ]
        loaded = run.of_kind("component_loaded")
        assert [event.data["unique_id"] for event in loaded] == [1, 2, 3]
        assert loaded[0].data["node"] == "/deep/ns/first"
        assert "went wrong" not in stop(run)


@pytest.mark.conforms("4.7 order", "D39")
@pytest.mark.parametrize("words", [("refuse=demo::Bad",), ("refuse=demo::Bad", "bare")])
def test_what_the_container_refuses_is_told_and_the_next_is_loaded(
    tmp_path: Path, words: tuple[str, ...]
) -> None:
    what = plan(container(*words), components=(component("bad"), component("good")))
    with launched(tmp_path, what, environment=DOMAIN) as run:
        run.await_event("component_loaded", "/good")
        (event,) = run.of_kind("component_failed", "/bad")
        assert event.data["reason"] == "no class demo::Bad"
        assert stop(run).endswith("; bad could not be loaded into ns/box: no class demo::Bad")


def test_a_trigger_loads_what_waits_for_it(tmp_path: Path) -> None:
    late = component("late", condition="event")
    triggers = (
        at_start(LoadAction("/late", HERE), delay=0.2),
        at_start(LoadAction("/late", HERE), delay=0.3),
    )
    what = plan(container(), components=(late, component("early")), triggers=triggers)
    with launched(tmp_path, what, environment=DOMAIN) as run:
        run.await_event("component_loaded", "/late")
        run.await_event("component_loaded", "/early")
        wait_for(lambda: "late is not loaded once more" in run.stderr, "the second trigger")
        stop(run)
        assert len(requests(run)) == 2


@pytest.mark.conforms("4.7 environment and respawn", "D39")
def test_a_container_that_starts_again_gets_its_components_again(tmp_path: Path) -> None:
    dying = component("dying", condition="event", plugin="Dying")
    triggers = (
        when(TriggerEvent("process_output", NAME, stream="stdout"), LoadAction("/dying", HERE), once=True),
    )
    box = container("die=Dying", restart=Restart("always", budget=1))
    what = plan(box, components=(component("first"), dying), triggers=triggers)
    run = finished(tmp_path, what, environment=DOMAIN)
    assert [item["plugin_name"] for item in requests(run)] == ["demo::First", "Dying"] * 2
    assert len(run.of_kind("component_loaded", "/first")) == 2
    (event,) = run.of_kind("component_failed")
    assert event.process == "/dying"
    assert event.data["reason"] == "ns/box has ended (exit code 9)"
    assert "dying could not be loaded" in run.stderr.splitlines()[-1]


@pytest.mark.conforms("4.7 wait", "D39")
def test_a_container_that_never_runs_fails_its_components(tmp_path: Path) -> None:
    what = plan(
        container(command=("/no/such/program",)),
        components=(component("first"), component("late", condition="event")),
        triggers=(at_start(LoadAction("/late", HERE), delay=0.2),),
    )
    run = finished(tmp_path, what, RunOptions(fail_on_any=True), environment=DOMAIN)
    assert run.popen.returncode == 1
    reasons = [event.data["reason"] for event in run.of_kind("component_failed")]
    assert len(reasons) == 2
    assert all("could not be started" in reason for reason in reasons)


@pytest.mark.parametrize("outside", [False, True])
def test_a_container_that_is_not_there_fails_all_of_its_components_at_once(
    tmp_path: Path, outside: bool
) -> None:
    place: dict[str, Any] = {"process": None, "container": "/nobody"} if outside else {}
    components = tuple(component(name, **place) for name in ("first", "second", "third"))
    what = plan(process("other", "exit=0") if outside else container("silent"), components=components)
    with launched(tmp_path, what, RunOptions(service_timeout=1.5), environment=DOMAIN) as run:
        run.await_event("component_failed", "/third")
        if not outside:
            run.send(signal.SIGINT)
        assert run.wait() == (0 if outside else 130)
        name = "/nobody" if outside else NAME
        assert {event.data["reason"] for event in run.of_kind("component_failed")} == {
            f"there was no service {name}/_container/load_node within 1.5 s"
        }


@pytest.mark.conforms("4.7 wait", "D39")
def test_a_container_that_hangs_is_an_error_with_a_cause(tmp_path: Path) -> None:
    what = plan(container("hang=demo::First"), components=(component("first"),))
    with launched(tmp_path, what, RunOptions(answer_timeout=3.0), environment=DOMAIN) as run:
        event = run.await_event("component_failed", "/first")
        assert event.data["reason"] == "/ns/box/_container/load_node did not answer within 3 s"
        assert "did not answer" in stop(run)


def test_a_container_that_is_none_of_the_plan_is_filled(tmp_path: Path) -> None:
    command = [sys.executable, str(PROCESSES / "container.py"), "/ns/box"]
    path = tmp_path / "container"
    with path.open("wb") as output:
        outside = subprocess.Popen(command, stdout=output, env={**os.environ, **DOMAIN})
    try:
        what = plan(components=(component("first", process=None), component("second", process=None)))
        run = finished(tmp_path, what, environment=DOMAIN)
        assert run.popen.returncode == 0, run.stderr
        assert len(run.of_kind("component_loaded")) == 2
        assert len(path.read_text().splitlines()) == 2
    finally:
        outside.kill()
        outside.wait()
        let_nobody_hang()


def test_a_component_may_be_a_lifecycle_node(tmp_path: Path) -> None:
    active = component("managed", plugin="Managed", lifecycle="active")
    triggers = (
        when(
            TriggerEvent("state_changed", "/managed", goal_state="active"),
            ChangeStateAction(("/managed",), (4,), HERE),
        ),
        when(
            TriggerEvent("state_changed", "/managed", start_state="deactivating", goal_state="inactive"),
            shutdown("all seen"),
        ),
    )
    run = finished(tmp_path, plan(container(), components=(active,), triggers=triggers), environment=DOMAIN)
    assert run.popen.returncode == 0, run.stderr
    assert [event.data["state"] for event in run.of_kind("transition_done", "/managed")][:2] == [
        "inactive",
        "active",
    ]


def test_components_that_are_active_are_deactivated_before_their_container_ends(tmp_path: Path) -> None:
    parts = tuple(component(name, plugin="Managed", lifecycle="active") for name in ("one", "two"))
    box = container(stop=Stop(timeout=30.0))
    with launched(tmp_path, plan(box, components=parts), environment=DOMAIN) as run:
        for part in parts:
            run.await_event("transition_done", part.id, count=2)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        (end,) = run.of_kind("process_ended", NAME)
        for part in parts:
            *_, last = run.of_kind("transition_done", part.id)
            assert last.data == {"transition": "deactivate", "state": "inactive"}
            assert last.monotonic < end.monotonic

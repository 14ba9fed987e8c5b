"""Containers of launch files, and nodes with a lifecycle in order, started by the supervisor."""

from __future__ import annotations

import os
import signal
from typing import TYPE_CHECKING, Any

import pytest

from orchestra import pipeline
from orchestra.resolve.inputs import Inputs
from orchestra.supervise.keeping import proc
from tests.supervise.plans import PROCESSES, Launched, launched

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Plan

_BOX = """
launch:
- node_container:
    pkg: rclcpp_components
    exec: component_container_isolated
    name: box
    namespace: ns
    restart: on-failure
    stop: {timeout: 30.0}
    composable_node:
    - {pkg: demo, plugin: "components:Broken", name: broken}
    - pkg: demo
      plugin: components:Plain
      name: first
      namespace: deep
      param: [{name: text, value: given}]
      remap: [{from: chatter, to: /loud}]
- load_composable_node:
    target: /ns/box
    composable_node:
    - {pkg: demo, plugin: "components:Everything", name: managed, autostart: true}
"""


@pytest.fixture
def environment(domain: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> dict[str, str]:
    monkeypatch.syspath_prepend(str(PROCESSES))
    return {name: value for name, value in domain.items() if os.environ.get(name) != value}


def _planned(folder: Path, text: str, name: str = "launch.yaml") -> Plan:
    path = folder / name
    path.write_text(text, "utf-8")
    return pipeline.make_plan(str(path), Inputs(os.environ))


def test_a_container_of_a_launch_file_is_filled_again_after_it_has_crashed(
    tmp_path: Path, environment: dict[str, str]
) -> None:
    with launched(tmp_path, _planned(tmp_path, _BOX), environment=environment) as run:
        run.await_event("transition_done", "/managed", count=2)
        loaded = {event.process: event.data for event in run.of_kind("component_loaded")}
        assert {name: data["node"] for name, data in loaded.items()} == {
            "/deep/first": "/deep/first",
            "/managed": "/managed",
        }
        (failed,) = run.of_kind("component_failed")
        reason = "Component constructor threw an exception: ValueError: no such device"
        assert (failed.process, failed.data["reason"]) == ("/broken", reason)
        (pid,) = (one for one in run.everything() if proc.marks(one, ("ORCHESTRA_PROCESS",)) == ("/ns/box",))
        os.kill(pid, signal.SIGKILL)
        run.await_event("transition_done", "/managed", count=4)
        assert run.of_kind("component_loaded", "/deep/first")[1].data["unique_id"] == 1
        run.send(signal.SIGINT)
        assert run.wait() == 130
        assert _steps(run, "/managed")[-1] == ("deactivate", "inactive")


_ORDER = """
launch:
- lifecycle_node: {script: SCRIPT, args: driver, name: driver, namespace: "", lifecycle: active, ready: {lifecycle: active}, stop: {timeout: 30.0}}
- lifecycle_node:
    script: SCRIPT
    args: mapper
    name: mapper
    namespace: ""
    lifecycle: active
    ready: {lifecycle: active}
    depends_on: [{node: driver, condition: ready}]
    stop: {timeout: 30.0}
- lifecycle_node: {script: SCRIPT, args: planner, name: planner, namespace: "", lifecycle: active, depends_on: [{node: mapper, condition: ready}], stop: {timeout: 30.0}}
"""


def test_lifecycle_nodes_come_up_and_go_down_in_the_order_of_what_they_depend_on(
    tmp_path: Path, environment: dict[str, str]
) -> None:
    text = _ORDER.replace("SCRIPT", str(PROCESSES / "lifecycle_node.py"))
    with launched(tmp_path, _planned(tmp_path, text), environment=environment) as run:
        run.await_event("transition_done", "/planner", count=2)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        names = ("driver", "mapper", "planner")
        up = [(f"/{name}", step) for name in names for step in ("configure", "activate")]
        down = [(f"/{name}", "deactivate") for name in reversed(names)]
        assert [(e.process, e.data["transition"]) for e in run.of_kind("transition_done")] == [*up, *down]
        ends = [event.process for event in run.of_kind("process_ended")]
        assert ends == [name for name, _ in down]


def _steps(run: Launched, name: str) -> list[tuple[Any, Any]]:
    found = run.of_kind("transition_done", name)
    return [(event.data["transition"], event.data["state"]) for event in found]

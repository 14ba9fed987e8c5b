"""The fork server in a run: one for all nodes, one fork per start, whatever becomes of it."""

from __future__ import annotations

import os
import signal
import sys
from dataclasses import replace
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.supervise.keeping import proc
from orchestra.supervise.options import RunOptions
from orchestra.values import Restart, Stop
from tests.supervise.plans import (
    PROCESSES,
    alive,
    assert_ended,
    finished,
    launched,
    name_of,
    plan,
    ready_when,
    wait_for,
)
from tests.supervise.warm.warming import both_ways, node, script, warm

if TYPE_CHECKING:
    from tests.supervise.plans import Launched

NODE = str(PROCESSES / "warm_node.py")
ENVIRONMENT = {"ROS_DOMAIN_ID": "63", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
# Six nodes that leave at once need some seconds where others are at work too.
PATIENT = Stop(timeout=30.0, kill_timeout=5.0)
AGAIN = Restart("on-failure", 0.0, 2.0, 30.0, None, 10.0)


def servers(run: Launched) -> list[int]:
    return [pid for pid in proc.descendants(run.own("orc-supervisor")) if name_of(pid) == "orc-warm"]


def parent(pid: int) -> int:
    facts = proc.stat(pid)
    assert facts
    return facts.parent


def test_nodes_are_forked_and_end_as_nodes_do(tmp_path: Path) -> None:
    """They are children of the supervisor, talk with each other, and leave when they are asked."""
    nodes = [
        node(f"n{index}", NODE, "--ros-args", "-r", f"__node:=n{index}", stop=PATIENT) for index in range(3)
    ]
    with launched(tmp_path, both_ways(*nodes), environment=ENVIRONMENT) as run:
        for one in nodes:
            run.await_line(one.id, "heard x", 3)
            run.await_line(f"{one.id}_cold", "heard x", 3)
        pids = {event.process: event.pid for event in run.of_kind("process_running")}
        assert len(servers(run)) == 1
        assert {parent(pid) for pid in pids.values() if pid} == {run.own("orc-supervisor")}
        for one in nodes:
            shared = _shared(pids[one.id])
            assert shared > 3 * _shared(pids[f"{one.id}_cold"]), "what is imported is there once"
            assert proc.command(pids[one.id] or 0) == proc.command(pids[f"{one.id}_cold"] or 0)
        run.send(signal.SIGINT)
        assert run.wait() == 130
        sent = {event.data["signal"] for event in run.of_kind("signal_sent")}
        assert sent == {"SIGINT"}, "each has left by itself"
        assert not run.of_kind("started_cold")
        assert not run.of_kind("left_behind")
        run.assert_gone()


def _shared(pid: int | None) -> int:
    """Return how much memory a process shares with copies of the same one, in KiB: pages of no file."""
    facts = Path(f"/proc/{pid}/smaps").read_text().split("VmFlags")
    anonymous = [block for block in facts if "Anonymous:             0 kB" not in block]
    return sum(
        int(line.split()[1])
        for block in anonymous
        for line in block.splitlines()
        if line.startswith("Shared_Dirty")
    )


def test_a_crashed_node_is_forked_again(tmp_path: Path) -> None:
    crashing = node("crashing", NODE, "crash", restart=AGAIN)
    with launched(tmp_path, warm(crashing), environment=ENVIRONMENT) as run:
        first = run.await_event("process_ended", "crashing", 1)
        server = servers(run)[0]
        run.await_event("process_ended", "crashing", 3)
        assert first.data["code"] == 9
        assert servers(run) == [server]
        assert not run.of_kind("started_cold")
        run.send(signal.SIGINT)
        run.wait()


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_nodes_outlive_the_server_and_the_next_one_starts_the_rest(
    tmp_path: Path, number: signal.Signals
) -> None:
    go = tmp_path / "go"
    crashing = node("crashing", script(tmp_path, "late.py", _until(go)), restart=AGAIN)
    lasting = node("lasting", script(tmp_path, "lasting.py", _until(tmp_path / "never")))
    with launched(tmp_path, warm(crashing, lasting)) as run:
        run.await_line("lasting", "up")
        run.await_line("crashing", "up")
        server = servers(run)[0]
        os.kill(server, number)
        wait_for(lambda: not alive(server), "the end of the server")
        go.touch()
        run.await_line("crashing", "up", 2)
        assert wait_for(lambda: servers(run), "another server") != [server]
        assert len(run.of_kind("process_ended", "lasting")) == 0
        before = run.everything()
        run.send(signal.SIGINT)
        run.assert_gone()
        assert_ended(before)
        assert run.wait() == 130


def _until(file: Path) -> str:
    return f"""
import os, sys, time
print("up", flush=True)
try:
    while not os.path.exists({str(file)!r}):
        time.sleep(0.02)
    sys.exit(1)
except KeyboardInterrupt:
    pass
"""


def test_a_server_that_is_stuck_is_killed_with_the_run(tmp_path: Path) -> None:
    """What is asked of it is not waited for when the run is to end."""
    lasting = script(tmp_path, "lasting.py", _until(tmp_path / "never"))
    crashing = node("crashing", script(tmp_path, "late.py", _until(tmp_path / "go")), restart=AGAIN)
    with launched(tmp_path, warm(node("lasting", lasting), crashing)) as run:
        run.await_line("lasting", "up")
        run.await_line("crashing", "up")
        os.kill(servers(run)[0], signal.SIGSTOP)
        (tmp_path / "go").touch()
        run.await_event("process_starting", "crashing", 2)
        before = run.everything()
        run.send(signal.SIGINT)
        run.assert_gone()
        assert_ended(before)
        assert run.wait() == 130


@pytest.mark.parametrize("target", ["orc-keeper", "orc-supervisor", "orc-warm"])
def test_whoever_is_killed_while_nodes_are_starting(tmp_path: Path, target: str) -> None:
    lasting = script(tmp_path, "lasting.py", _until(tmp_path / "never"))
    with launched(tmp_path, warm(*(node(f"n{index}", lasting) for index in range(8)))) as run:
        os.kill(run.own(target), signal.SIGKILL)
        if target == "orc-warm":
            for index in range(8):
                run.await_line(f"n{index}", "up")
            run.send(signal.SIGINT)
        before = run.everything()
        run.assert_gone()
        assert_ended(before)
        run.wait()


def test_without_rclpy_nodes_are_started_cold_and_it_is_told(tmp_path: Path) -> None:
    broken = tmp_path / "rclpy"
    broken.mkdir()
    (broken / "__init__.py").write_text("raise ImportError('not today')")
    quick = script(tmp_path, "quick.py", "print('up')")
    environment = {"PYTHONPATH": os.pathsep.join((str(tmp_path), os.environ.get("PYTHONPATH", "")))}
    run = finished(tmp_path, warm(node("a", quick), node("b", quick)), environment=environment)
    assert run.log("a") == run.log("b") == "up\n"
    reasons = [event.data["reason"] for event in run.of_kind("started_cold")]
    assert reasons == ["the fork server is of no use: ImportError: not today"] * 2
    assert run.stderr.count("not today") == 1
    assert run.wait() == 0


def test_a_module_of_the_program_itself_is_not_replaced_by_one_of_the_server(tmp_path: Path) -> None:
    own = script(tmp_path, "own.py", "import yaml; print(yaml.OURS)")
    (tmp_path / "yaml.py").write_text("OURS = 1")
    run = finished(tmp_path, both_ways(node("own", own)))
    assert run.log("own") == run.log("own_cold") == "1\n"
    (cold,) = run.of_kind("started_cold")
    assert cold.data["reason"].endswith("has a module 'yaml' of its own")


def test_a_module_that_is_installed_as_a_script_too_replaces_nothing(tmp_path: Path) -> None:
    """empy lies beside all console scripts of an environment, and rclpy needs it."""
    pytest.importorskip("rclpy", reason="needs ROS")
    module = find_spec("em")
    assert module is not None
    assert module.origin is not None
    _, _, rest = Path(module.origin).read_bytes().partition(b"\n")
    (tmp_path / "em.py").write_bytes(b"#!/somewhere/else/python\n" + rest)
    own = script(tmp_path, "own.py", "print('up')")
    run = finished(tmp_path, both_ways(node("own", own)))
    assert run.log("own") == "up\n"
    assert not run.of_kind("started_cold")


def test_without_it_there_is_no_server(tmp_path: Path) -> None:
    lasting = script(tmp_path, "lasting.py", _until(tmp_path / "never"))
    with launched(tmp_path, warm(node("n", lasting)), RunOptions(warm=False)) as run:
        run.await_line("n", "up")
        assert servers(run) == []
        assert not run.of_kind("started_cold")
        run.send(signal.SIGINT)
        assert run.wait() == 130


def test_a_server_that_nobody_needs_any_more_ends(tmp_path: Path) -> None:
    quick = node("quick", script(tmp_path, "quick.py", "print('up')"))
    cold = replace(node("cold", sys.executable, "-c", "import time; time.sleep(100)"), warm=None)
    with launched(tmp_path, plan(*warm(quick).processes, cold)) as run:
        run.await_event("process_exited", "quick")
        wait_for(lambda: not servers(run), "the end of the server")
        run.send(signal.SIGINT)
        run.wait()


def test_many_are_started_by_one_server(tmp_path: Path) -> None:
    quick = script(tmp_path, "quick.py", "import os; print(os.getppid())")
    run = finished(tmp_path, warm(*(node(f"n{index}", quick) for index in range(60))))
    assert len({run.log(f"n{index}") for index in range(60)}) == 1, "all have the supervisor as their parent"
    assert len(run.of_kind("process_exited")) == 60
    assert not run.of_kind("descendant_adopted")
    assert not run.of_kind("started_cold")


def test_what_a_node_leaves_behind_is_its_own(tmp_path: Path) -> None:
    """A copy of the node that detaches itself is known by its marks, as one of a cold start is."""
    forking = """
import os, time
if os.fork() == 0:
    os.setsid()
    if os.fork() == 0:
        os.write(1, b"detached\\n")
        time.sleep(100)
    os._exit(0)
os.wait()
os.write(1, b"up\\n")
time.sleep(100)
"""
    wanted = both_ways(node("forking", script(tmp_path, "forking.py", forking)))
    with launched(tmp_path, wanted) as run:
        for name in ("forking", "forking_cold"):
            run.await_line(name, "detached")
            run.await_line(name, "up")
        run.send(signal.SIGINT)
        run.assert_gone()
        for name in ("forking", "forking_cold"):
            assert len(run.of_kind("descendant_adopted", name)) == 1


def test_its_readiness_is_seen(tmp_path: Path) -> None:
    speaking = node("speaking", NODE, ready=ready_when(message="/said"))
    with launched(tmp_path, warm(speaking), environment=ENVIRONMENT) as run:
        run.await_event("process_ready", "speaking")
        run.send(signal.SIGINT)
        assert run.wait() == 130

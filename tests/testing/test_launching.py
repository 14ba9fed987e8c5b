"""The fixtures `launch` and `plan`, as users of the test kit write with them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import DescriptionError
from orchestra.supervise.keeping import proc
from orchestra.testing import Run, launched

if TYPE_CHECKING:
    from pathlib import Path

    from orchestra.plan.model import Plan

Launch = Callable[..., Run]

_COUNTER = "sh -c 'echo counting; i=0; while sleep 0.05; do i=`expr $i + 1`; echo $i; done'"


def _description(*processes: dict[str, Any]) -> dict[str, Any]:
    return {"launch": [{"executable": {"cmd": _COUNTER, **process}} for process in processes]}


def _two() -> dict[str, Any]:
    return _description(
        {"name": "first", "ready": {"log": "^3$", "timeout": 20.0}},
        {"name": "second", "depends_on": [{"process": "first", "condition": "ready"}]},
    )


def test_a_run_is_waited_for_read_and_stopped(launch: Launch) -> None:
    run = launch(_two())
    run.wait_ready()
    assert [process.id for process in run.plan.processes] == ["first", "second"]
    assert "counting" in run.logs("first")
    assert run.wait_for_log(r"^(\d+)$", "second").group(1) == "1"
    ready, began = (
        run.wait_for_event("process_ready", "first"),
        run.wait_for_event("process_running", "second"),
    )
    assert ready.monotonic <= began.monotonic
    assert run.stop() == 130
    assert run.events[-1].kind == "run_ended"
    assert run.survivors() == ()


def test_a_launch_file_with_arguments(launch: Launch, tmp_path: Path) -> None:
    file = tmp_path / "greet.launch.yaml"
    file.write_text('launch: [arg: {name: who}, executable: {cmd: "echo hello $(var who)", name: greet}]\n')
    run = launch(file, "who:=world")
    assert run.wait() == 0
    assert run.logs("greet") == "hello world\n"
    assert "hello world" in run.output


def test_two_runs_do_not_hear_each_other(launch: Launch, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    shows = {
        "launch": [
            {
                "executable": {
                    "cmd": "sh -c 'echo $ROS_DOMAIN_ID $ROS_AUTOMATIC_DISCOVERY_RANGE'",
                    "name": "env",
                }
            }
        ]
    }
    one, other = launch(shows), launch(shows)
    assert one.domain != other.domain
    for run in (one, other):
        assert run.wait() == 0
        assert run.logs("env") == f"{run.domain} LOCALHOST\n"
        assert run.environment["ROS_DOMAIN_ID"] == str(run.domain)


def test_variables_can_be_given(launch: Launch) -> None:
    shows = {"launch": [{"executable": {"cmd": "sh -c 'echo $GIVEN $ROS_DOMAIN_ID'", "name": "env"}}]}
    run = launch(shows, environment={"GIVEN": "yes", "ROS_DOMAIN_ID": "80"})
    assert run.wait() == 0
    assert run.logs("env") == "yes 80\n"


def test_a_run_can_end_with_a_block(launch: Launch) -> None:
    with launch(_description({"name": "counter"})) as run:
        run.wait_ready("counter")
        pid = run.pid
    assert proc.stat(pid) is None


def test_waiting_for_what_never_comes_tells_what_was_awaited(tmp_path: Path) -> None:
    with launched(_description({"name": "counter"}), home=tmp_path) as run:
        run.wait_for_log("counting")
        with pytest.raises(
            AssertionError, match=r"waited 0\.1 s in vain for output of counter that matches 'never'"
        ) as told:
            run.wait_for_log("never", "counter", timeout=0.1)
        assert "counting" in str(told.value)
        with pytest.raises(LookupError, match="did you mean counter"):
            run.logs("countr")


def test_waiting_ends_when_the_run_does(tmp_path: Path) -> None:
    with launched({"launch": [{"executable": {"cmd": "true", "name": "brief"}}]}, home=tmp_path) as run:
        with pytest.raises(AssertionError, match="the run ended with status 0 before output"):
            run.wait_for_log("never")
        assert run.wait() == 0


def test_waiting_for_a_process_that_fails_ends_at_once(tmp_path: Path) -> None:
    description = _description(
        {"name": "counter"}, {"name": "fails", "cmd": "false", "ready": {"log": "never"}}
    )
    with launched(description, home=tmp_path) as run, pytest.raises(AssertionError, match="fails failed"):
        run.wait_ready()


def test_a_run_that_fails_unseen_fails_the_test(tmp_path: Path) -> None:
    description = {"launch": [{"executable": {"cmd": "sh -c 'exit 7'", "name": "fails", "required": True}}]}
    with ExitStack() as stack:
        run = stack.enter_context(launched(description, home=tmp_path))
        run.wait_for_event("run_ended")
        _until(lambda: _is_over(run.pid))
        with pytest.raises(AssertionError, match="the run ended by itself with status 7"):
            stack.close()


def test_a_description_that_is_wrong_fails_the_test_with_its_problems(tmp_path: Path) -> None:
    with (
        pytest.raises(AssertionError, match="did you mean 'cmd'"),
        launched({"launch": [{"executable": {"cdm": "x"}}]}, home=tmp_path) as run,
    ):
        run.wait_ready()


def test_an_expected_failure_is_none(launch: Launch) -> None:
    run = launch({"launch": [{"executable": {"cmd": "sh -c 'exit 7'", "name": "fails", "required": True}}]})
    assert run.wait() == 7


def test_what_outlives_the_run_is_found_and_ended(tmp_path: Path) -> None:
    """The run's own processes are stopped and then killed all at once, so that nobody cleans up.

    A program is told by the kernel that its supervisor has been killed; one that ignores that stays.
    """
    with ExitStack() as stack:
        run = stack.enter_context(
            launched(
                _description({"name": "stays", "cmd": "env --ignore-signal=TERM sleep 300"}), home=tmp_path
            )
        )
        run.wait_ready()
        (left,) = [survivor for survivor in run.survivors() if survivor.process == "stays"]
        ours = [run.pid, *(pid for pid in proc.descendants(run.pid) if pid != left.pid)]
        for number in (signal.SIGSTOP, signal.SIGKILL):
            for pid in ours:
                os.kill(pid, number)
        with pytest.raises(AssertionError, match=r"left something behind: stays: sleep 300"):
            stack.close()
        _until(lambda: _is_over(left.pid))


def test_what_failed_in_the_test_is_told_first(tmp_path: Path) -> None:
    description = {"launch": [{"executable": {"cmd": "sh -c 'exit 7'", "name": "fails", "required": True}}]}
    with pytest.raises(ZeroDivisionError) as told, launched(description, home=tmp_path) as run:
        _divide_when_over(run)
    assert "with status 7" in told.value.__notes__[0]


def _divide_when_over(run: Run) -> float:
    run.wait_for_event("run_ended")
    _until(lambda: _is_over(run.pid))
    return 1 / 0


def test_a_session_that_is_killed_leaves_nothing_behind(tmp_path: Path) -> None:
    script = tmp_path / "session.py"
    script.write_text(
        "import pathlib, sys\n"
        "from orchestra.testing import launched\n"
        f"with launched({_description({'name': 'counter'})!r}, home=pathlib.Path({str(tmp_path / 'home')!r})) as run:\n"
        "    run.wait_ready()\n"
        "    print(run.pid, *(survivor.pid for survivor in run.survivors()), flush=True)\n"
        "    sys.stdin.read()\n"
    )
    with subprocess.Popen(
        [sys.executable, str(script)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as session:
        assert session.stdout
        pids = [int(word) for word in session.stdout.readline().split()]
        assert len(pids) >= 2
        session.kill()
    _until(lambda: all(map(_is_over, pids)))


def test_a_plan_is_made_without_starting_anything(plan: Callable[..., Plan]) -> None:
    made = plan(_two())
    assert [process.id for process in made.processes] == ["first", "second"]
    assert made.processes[1].depends_on[0].process == "first"


def test_a_plan_that_cannot_be_made_says_why(plan: Callable[..., Plan]) -> None:
    with pytest.raises(DescriptionError) as told:
        plan({"launch": [{"executable": {"cdm": "x"}}]})
    assert any("cdm" in note for note in told.value.__notes__)


def test_the_plug_in_works_outside_this_repository(tmp_path: Path) -> None:
    """A project of its own with pytest's own settings; the environment's warnings are its own business."""
    (tmp_path / "robot.launch.yaml").write_text("launch: [executable: {cmd: sleep 60, name: robot}]\n")
    (tmp_path / "test_robot.py").write_text(
        "def test_it_comes_up(launch):\n"
        "    launch('robot.launch.yaml').wait_ready('robot')\n\n"
        "def test_its_plan(plan):\n"
        "    assert plan('robot.launch.yaml').processes[0].command == ('sleep', '60')\n"
    )
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", str(tmp_path)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    assert done.returncode == 0, done.stdout
    assert "2 passed" in done.stdout


def _is_over(pid: int) -> bool:
    facts = proc.stat(pid)
    return facts is None or facts.state in "ZX"


def _until(condition: Callable[[], bool], seconds: float = 30.0) -> None:
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.02)

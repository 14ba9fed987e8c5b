"""`orchestra crash`, and limits that a machine cannot grant, as users see both."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

    from .conftest import Command


@pytest.fixture
def orchestra(orchestra_quickly: Command) -> Command:
    """Run the command; what starts nothing, in this process."""
    return orchestra_quickly


TWO_CRASHES = """\
launch:
  - push_ros_namespace: {namespace: robot1}
  - executable: {name: camera, cmd: sh -c 'echo no device; exit 66'}
  - executable: {name: lidar, cmd: sh -c 'sleep 0.3; kill -SEGV $$'}
  - executable: {name: base, cmd: 'true'}
"""


@pytest.fixture
def crashed(folder: Path, orchestra: Command) -> Path:
    """The folder of a run in which two processes crashed, the lidar last."""
    (folder / "robot.yaml").write_text(TWO_CRASHES)
    done = orchestra("launch", "robot.yaml")
    assert done.returncode == 0, done.stderr
    (path,) = (folder.parent / "home" / "runs").iterdir()
    return path


def test_the_latest_crash_is_shown_and_the_others_are_listed(orchestra: Command, crashed: Path) -> None:
    shown = orchestra("crash")
    assert (shown.returncode, shown.stderr) == (0, "")
    assert shown.stdout.startswith("lidar: SIGSEGV")
    first, before = shown.stdout.split("\nbefore that\n")
    assert f"all of it is in {crashed}/crash/lidar-1\n" in first
    assert before.endswith(f"camera  exit code 66  {crashed}/crash/camera-1\n")


def test_the_crash_of_a_process(orchestra: Command, crashed: Path) -> None:
    shown = orchestra("crash", "cam*", "--run", crashed.name).stdout
    assert shown.startswith("camera: exit code 66\n    an input file is missing")
    assert "    no device\n" in shown
    assert "before that" not in shown


@pytest.mark.usefixtures("crashed")
def test_crashes_for_programs(orchestra: Command) -> None:
    documents = json.loads(orchestra("crash", "--format", "json").stdout)
    assert [document["process"] for document in documents] == ["lidar", "camera"]
    assert documents[1]["cause"]["code"] == 66
    assert json.loads(orchestra("crash", "base", "--format", "json").stdout) == []


@pytest.mark.usefixtures("crashed")
def test_a_list_of_crashes(orchestra: Command) -> None:
    lines = orchestra("crash", "--list").stdout.splitlines()
    assert [line.split("  ")[1] for line in lines] == ["lidar", "camera"]


@pytest.mark.usefixtures("crashed")
def test_nothing_to_show(orchestra_beside: Command) -> None:
    shown = orchestra_beside("crash", "base")
    assert (shown.returncode, shown.stdout) == (0, "")
    assert "nothing has crashed in" in shown.stderr
    unknown = orchestra_beside("crash", "camra")
    assert unknown.returncode == 2
    assert "no process is called 'camra'; did you mean 'camera'?" in unknown.stderr


def test_no_run_at_all(orchestra: Command) -> None:
    assert orchestra("crash").returncode == 1


def test_a_report_that_is_torn_is_left_out(orchestra: Command, crashed: Path) -> None:
    (crashed / "crash" / "lidar-1" / "report.json").write_text("{")
    assert orchestra("crash").stdout.startswith("camera: exit code 66")


UNFIT = """\
launch:
  - executable:
      cmd: 'true'
      limits: {cores: [4095]}
"""


def test_limits_that_a_machine_cannot_grant_are_problems_like_others(
    folder: Path, orchestra: Command
) -> None:
    (folder / "unfit.yaml").write_text(UNFIT)
    refused = orchestra("launch", "unfit.yaml")
    assert refused.returncode == 2
    assert "unfit.yaml:2:5: error: true: there is no core 4095" in refused.stderr
    assert "[ORC055]" in refused.stderr
    assert not (folder.parent / "home" / "runs").exists()
    (problem,) = json.loads(orchestra("launch", "unfit.yaml", "--format", "json").stderr)
    assert (problem["code"], problem["line"]) == ("ORC055", 2)
    assert orchestra("check", "unfit.yaml").returncode == 0


def test_caps_beyond_the_memory_there_is_are_a_warning(folder: Path, orchestra: Command) -> None:
    (folder / "big.yaml").write_text(UNFIT.replace("cores: [4095]", "memory: 900000G, nice: 0"))
    told = orchestra("launch", "big.yaml")
    if "memory cannot be capped" in told.stderr:
        pytest.skip("no control group can be made here")
    assert (
        "warning: true: the memory caps come to" in told.stderr or "warning: the memory caps" in told.stderr
    )
    assert told.returncode == 0
    assert orchestra("launch", "big.yaml", "--strict").returncode == 2

"""`orchestra check`: all that is wrong in files and folders, on standard output."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from pathlib import Path

Command = Callable[..., CompletedProcess[str]]


@pytest.fixture
def orchestra(orchestra_quickly: Command) -> Command:
    """Run the command; what starts nothing, in this process."""
    return orchestra_quickly


_ROBOT = """\
launch:
  - arg: {name: robot}
  - executable: {cmd: "echo $(var robot) $(var fleet)", name: hello}
"""
_FLEET = """\
launch:
  - let: {name: fleet, value: north}
  - include: {file: robot.launch.yaml, arg: [{name: robot, value: r1}]}
  - include: {file: robot.launch.yaml, arg: [{name: robot, value: r2}]}
"""


def _write(folder: Path, **files: str) -> None:
    for name, text in files.items():
        (folder / f"{name}.launch.yaml").write_text(text)


def _told(found: CompletedProcess[str]) -> list[tuple[str, str, int]]:
    return [(problem["code"], problem["file"], problem["line"]) for problem in json.loads(found.stdout)]


def test_nothing_wrong(orchestra_beside: Command, folder: Path) -> None:
    _write(folder, fine="launch: [log: {message: hello}]\n")
    found = orchestra_beside("check", ".")
    assert (found.returncode, found.stderr, found.stdout) == (0, "", "no problems in 1 file\n")
    assert orchestra_beside("check", ".", "--format", "json").stdout == "[]\n"


def test_an_included_file_is_judged_by_how_it_is_used(orchestra: Command, folder: Path) -> None:
    _write(folder, robot=_ROBOT, fleet=_FLEET)
    found = orchestra("check", ".")
    assert (found.returncode, found.stdout) == (0, "no problems in 2 files\n")


def test_what_the_same_file_alone_lacks_is_a_note(
    orchestra: Command, orchestra_beside: Command, folder: Path
) -> None:
    """Whoever launches it gives the argument; a call that gives others is one that would fail."""
    _write(folder, robot=_ROBOT)
    found = orchestra("check", "robot.launch.yaml", "--format", "json")
    told = {problem["code"]: problem["severity"] for problem in json.loads(found.stdout)}
    assert told == {"ORC022": "note", "ORC020": "error"}  # a variable that nothing declares may be a slip
    assert "error: the argument 'robot'" in orchestra_beside("plan", "robot.launch.yaml").stderr


_PART = "launch:\n- arg: {name: robot}\n- log: {message: $(var robot)}\n"
_ARMS = "$(find-pkg-share arms)/launch/part.launch.yaml"


def _source(folder: Path) -> None:
    launch = folder / "src/arms/launch"
    launch.mkdir(parents=True)
    _write(launch, part=_PART)
    _write(folder / "src", main=f"launch: [include: {{file: {_ARMS}, arg: [{{name: robot, value: r1}}]}}]\n")


def test_what_a_file_of_a_package_that_is_yet_to_be_built_lacks_is_not_told(
    orchestra: Command, folder: Path
) -> None:
    _source(folder)
    told = _told(orchestra("check", "src", "--format", "json"))
    assert told == [("ORC030", "src/main.launch.yaml", 1)]
    (folder / "src/arms").rename(folder / "src/legs")
    told = _told(orchestra("check", "src", "--format", "json"))
    assert ("ORC022", "src/legs/launch/part.launch.yaml", 2) in told


def test_what_a_file_lacks_of_which_a_copy_is_installed_and_included_is_not_told(
    orchestra: Command, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _source(folder)
    shares = folder / "install/share"
    shutil.copytree(folder / "src/arms", shares / "arms")
    (shares / "ament_index/resource_index/packages").mkdir(parents=True)
    (shares / "ament_index/resource_index/packages/arms").touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(folder / "install"))
    assert orchestra("check", "src").stdout == "no problems in 2 files\n"


def test_arguments_can_be_given(orchestra: Command, folder: Path) -> None:
    two = "launch:\n- arg: {name: robot}\n- arg: {name: speed}\n- log: {message: $(var robot) $(var speed)}\n"
    _write(folder, two=two)
    assert "2 notes" in orchestra("check", ".").stdout
    lacking = orchestra("check", ".", "robot:=r1")
    assert (lacking.returncode, "1 error" in lacking.stdout) == (2, True)
    assert orchestra("check", ".", "robot:=r1", "speed:=2").stdout == "no problems in 1 file\n"


def test_a_problem_of_an_included_file_is_told_once(orchestra: Command, folder: Path) -> None:
    _write(folder, robot=_ROBOT.replace("name: hello", "nmae: hello"), fleet=_FLEET)
    found = orchestra("check", ".", "--format", "json")
    assert _told(found) == [("ORC004", "robot.launch.yaml", 3)]
    (problem,) = json.loads(found.stdout)
    assert [place["file"] for place in problem["included_from"]] == ["fleet.launch.yaml"]


def test_files_that_include_each_other_are_both_looked_at(orchestra: Command, folder: Path) -> None:
    _write(
        folder,
        a="launch:\n  - include: {file: b.launch.yaml}\n  - lgo: {}\n",
        b="launch:\n  - include: {file: a.launch.yaml}\n  - nod: {}\n",
    )
    found = orchestra("check", ".", "--format", "json")
    assert found.returncode == 2
    assert {file for code, file, _ in _told(found) if code == "ORC007"} == {"a.launch.yaml", "b.launch.yaml"}
    assert "ORC028" in {code for code, _, _ in _told(found)}


def test_parameter_files_are_read_as_rcl_does(orchestra: Command, folder: Path) -> None:
    (folder / "good.yaml").write_text("/talker:\n  ros__parameters:\n    rate: 1\n")
    assert orchestra("check", ".").stdout == "no problems in 1 file\n"
    (folder / "bad.yaml").write_text("/talker:\n  ros__parameters:\n    rate: [1, two]\n")
    found = orchestra("check", ".", "--format", "json")
    assert found.returncode == 2
    assert {(file, line) for _, file, line in _told(found)} == {("bad.yaml", 3)}


def test_a_name_with_a_substitution_is_judged_where_it_is_known_whether_that_is_evaluated(
    orchestra: Command, folder: Path
) -> None:
    (folder / "params.yaml").write_text("$(var robot)/talker:\n  ros__parameters:\n    rate: [1, two]\n")
    found = orchestra("check", "params.yaml", "--format", "json")
    assert _told(found) == [("ORC041", "params.yaml", 3)]
    (folder / "params.yaml").write_text("$(var robot)/talker:\n  ros__parameters:\n    rate: 1\n")
    assert orchestra("check", "params.yaml").returncode == 0
    node = "launch: [node: {exec: sleep, name: talker, param: [{from: params.yaml}]}]\n"
    _write(folder, robot=node)
    assert ("ORC040", "params.yaml", 1) in _told(orchestra("check", "robot.launch.yaml", "--format", "json"))


def test_an_action_that_a_package_adds_is_needed_where_it_is_started(
    orchestra: Command, orchestra_beside: Command, folder: Path
) -> None:
    _write(folder, world="launch: [gz_server: {world_sdf_file: empty.sdf}]\n")
    assert orchestra("check", "world.launch.yaml").returncode == 0
    assert orchestra_beside("plan", "world.launch.yaml").returncode == 2


def test_all_mistakes_of_a_folder_are_told_at_once(orchestra: Command, folder: Path) -> None:
    _write(folder, a="launch:\n  - executable: {cdm: x}\n", b="launch:\n  - log: {message: $(vra x)}\n")
    found = orchestra("check", ".")
    assert found.returncode == 2
    assert "a.launch.yaml:2:" in found.stdout
    assert "b.launch.yaml:2:" in found.stdout
    assert "help: did you mean 'cmd'?" in found.stdout
    assert "help: did you mean 'var'?" in found.stdout
    assert found.stderr == ""


_LEAKING = "launch:\n  - include: {file: fine.launch.yaml, arg: [{name: nobody, value: x}]}\n"


@pytest.mark.parametrize(("words", "status"), [((), 0), (("--strict",), 2)])
def test_warnings_are_mistakes_where_that_is_asked_for(
    orchestra: Command, folder: Path, words: tuple[str, ...], status: int
) -> None:
    _write(folder, fine="launch: [log: {message: hello}]\n", leaking=_LEAKING)
    found = orchestra("check", ".", *words)
    assert found.returncode == status
    assert ("1 error" if status else "1 warning") in found.stdout


@pytest.mark.parametrize("name", ["github", "sarif"])
def test_other_formats(orchestra: Command, folder: Path, name: str) -> None:
    _write(folder, a="launch:\n  - executable: {cdm: x}\n")
    found = orchestra("check", ".", "--format", name)
    assert (found.returncode, found.stderr) == (2, "")
    assert "a.launch.yaml" in found.stdout
    assert "ORC004" in found.stdout


_ASKING = """\
import os
from launch import LaunchDescription
from launch.actions import LogInfo

def generate_launch_description():
    {}
    return LaunchDescription([LogInfo(msg=model + '.yaml')])
"""


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.launch.yaml", "launch:\n- log: {message: $(env QQ_MODEL)}\n"),
        ("a.launch.py", _ASKING.format("model = os.environ['QQ_MODEL']")),
        ("a.launch.py", _ASKING.format("model = os.getenv('QQ_MODEL')")),
        (
            "a.launch.py",
            _ASKING.format("try: model = os.environ['QQ_MODEL']\n    except KeyError: raise SystemExit(1)"),
        ),
    ],
)
def test_an_unset_environment_variable_is_noted_until_it_is_set(
    orchestra_beside: Command, folder: Path, name: str, text: str
) -> None:
    """Where only a check is made, that is: a plan needs its value."""
    (folder / name).write_text(text)
    for _ in range(2):  # the second time nothing has changed
        found = orchestra_beside("check", name, "--format", "json")
        (problem,) = json.loads(found.stdout)
        assert (found.returncode, problem["severity"], problem["code"]) == (0, "note", "ORC021")
        line = text.splitlines()[problem["line"] - 1]
        assert line[problem["column"] - 1 : problem["end_column"] - 1] == "QQ_MODEL"
    assert orchestra_beside("plan", name).returncode == 2
    assert orchestra_beside("check", name, QQ_MODEL="burger").stdout == "no problems in 1 file\n"
    assert "1 note" in orchestra_beside("check", name).stdout


def test_what_is_left_at_the_end_is_not_searched_for_garbage(tmp_path: Path) -> None:
    _write(tmp_path, plain="launch: []")
    program = (
        "import gc, sys; from orchestra.__main__ import main; print(main(), gc.get_freeze_count() > 10_000)"
    )
    words = [sys.executable, "-c", program, "check", "plain.launch.yaml"]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == ["no problems in 1 file", "0 True"]

"""Notes of `orchestra check`: what this machine lacks and another one may have, which is no fault of the files."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Final

import pytest

if TYPE_CHECKING:
    from pathlib import Path
    from subprocess import CompletedProcess

    from tests.cli.conftest import Command

_PYTHON: Final = """\
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription, LogInfo
from launch.substitutions import Command, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare
%s

def generate_launch_description():
    return LaunchDescription([%s])
"""
_SHARE: Final = "PathJoinSubstitution([FindPackageShare('qq_arm'), 'launch', 'arm.launch.py'])"


@pytest.fixture
def orchestra(orchestra_here: Command) -> Command:
    """Run `orchestra check` in this process, as where no workspace is sourced; nothing is kept."""

    def run(*words: str, **environment: str) -> CompletedProcess[str]:
        return orchestra_here("check", "--no-cache", *words, **{"AMENT_PREFIX_PATH": "", **environment})

    return run


@pytest.mark.parametrize(
    ("name", "text", "code"),
    [
        (
            "a.launch.yaml",
            "launch:\n- node: {pkg: qq_arm, exec: zzzzzz, param: [{from: $(find-pkg-share qq_arm)/a.yaml}]}\n",
            "ORC030",
        ),
        (
            "a.launch.yaml",
            "launch:\n- include: {file: $(find-pkg-share qq_arm)/launch/a.launch.yaml}\n",
            "ORC030",
        ),
        ("a.launch.yaml", "launch:\n- log: {message: $(command 'qq_xacro a.xacro')}\n", "ORC031"),
        ("a.launch.yaml", "launch:\n- node: {module: qq_arm.driver, name: arm}\n", "ORC031"),
        ("a.launch.yaml", "launch:\n- gz_server: {world_sdf_file: empty.sdf}\n", "ORC007"),
        (
            "a.launch.py",
            _PYTHON % ("", f"IncludeLaunchDescription({_SHARE}), Node(package='qq_arm', executable='b')"),
            "ORC030",
        ),
        (
            "a.launch.py",
            _PYTHON
            % (
                "from ament_index_python.packages import get_package_share_directory\nqq = get_package_share_directory('qq_arm')",
                "",
            ),
            "ORC030",
        ),
        ("a.launch.py", _PYTHON % ("import qq_arm", ""), "ORC036"),
        ("a.launch.py", _PYTHON % ("", "LogInfo(msg=Command('qq_xacro a.xacro'))"), "ORC031"),
    ],
)
def test_what_comes_with_a_package_is_noted_once_and_a_warning_where_a_workspace_is_sourced(
    orchestra: Command, folder: Path, prefix: Path, name: str, text: str, code: str
) -> None:
    (folder / name).write_text(text)
    sourced = "note" if "qq_xacro" in text else "warning"  # no workspace has the programs of the PATH
    for workspace, weight in (("", "note"), (str(prefix), sourced)):
        found = orchestra(name, "--format", "json", AMENT_PREFIX_PATH=workspace)
        told = [(problem["severity"], problem["code"]) for problem in json.loads(found.stdout)]
        assert (found.returncode, told) == (0, [(weight, code)])


_ARGUMENT: Final = """\
import os
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import EnvironmentVariable, LaunchConfiguration

def generate_launch_description():
    model = %s
    return LaunchDescription([
        DeclareLaunchArgument('model', default_value=model, choices=['a', 'b']),
        LogInfo(msg=LaunchConfiguration('model')),
    ])
"""


@pytest.mark.parametrize(
    ("name", "text"),
    [
        (
            "a.launch.yaml",
            "launch:\n- arg: {name: model, default: $(env QQ_MODEL ''), choice: [{value: a}, {value: b}]}\n",
        ),
        (
            "a.launch.xml",
            """<launch><arg name="model" default="$(env QQ_MODEL '')"><choice value="a"/></arg></launch>\n""",
        ),
        ("a.launch.py", _ARGUMENT % "EnvironmentVariable('QQ_MODEL', default_value='')"),
        ("a.launch.py", _ARGUMENT % "os.environ.get('QQ_MODEL', '')"),
        ("a.launch.py", _ARGUMENT % "os.getenv('QQ_MODEL', '')"),
    ],
)
def test_an_empty_default_that_is_no_choice_asks_for_the_variable_that_is_read_before_it(
    orchestra: Command, folder: Path, name: str, text: str
) -> None:
    """So a robot says what it is: there the variable is set."""
    (folder / name).write_text(text)
    for value, told in (
        ({}, [("note", "ORC021")]),
        ({"QQ_MODEL": "a"}, []),
        ({"QQ_MODEL": "z"}, [("error", "ORC023")]),
    ):
        found = orchestra(name, "--format", "json", **value)
        assert [(problem["severity"], problem["code"]) for problem in json.loads(found.stdout)] == told
    (folder / name).write_text(text.replace("''", "'z'"))  # a default that is meant to be one of them
    assert "ORC023" in orchestra(name).stdout


def test_what_is_kept_of_a_file_is_weighed_anew_where_another_workspace_is_sourced(
    orchestra_beside: Command, folder: Path, prefix: Path
) -> None:
    (folder / "a.launch.yaml").write_text("launch: [node: {pkg: qq_arm, exec: zzz}]\n")
    for workspace, told in (("", "1 note"), (str(prefix), "1 warning"), ("", "1 note")):
        assert told in orchestra_beside("check", ".", AMENT_PREFIX_PATH=workspace).stdout
    assert orchestra_beside("check", ".", AMENT_PREFIX_PATH="").stdout.endswith(", 1 unchanged\n")


def test_notes_are_no_problems_and_stay_where_warnings_are_errors(orchestra: Command, folder: Path) -> None:
    text = "launch:\n- arg: {name: robot}\n- node: {pkg: qq_arm, exec: zzz, name: $(env QQ_MODEL)}\n"
    (folder / "a.launch.yaml").write_text(text)
    (folder / "b.launch.yaml").write_text(text)
    found = orchestra(".", "--strict")
    assert found.returncode == 0
    assert found.stdout.endswith("\n6 notes\nno problems in 2 files\n")
    assert "(2 places in 2 files)" in found.stdout
    every = orchestra(".", "--notes", "all").stdout
    assert every.count("note: there is no package 'qq_arm'") == 2
    assert orchestra(".", "--notes", "none").stdout == "no problems in 2 files\n"
    assert orchestra(".", "--notes", "none", "--format", "github").stdout == ""


@pytest.mark.parametrize(("number", "last"), [(10, None), (11, "1 other"), (12, "2 others")])
def test_no_more_notes_are_shown_than_can_be_taken_in(
    orchestra: Command, folder: Path, number: int, last: str | None
) -> None:
    nodes = "".join(f"- node: {{pkg: qq_arm_{letter}, exec: zzzzzz}}\n" for letter in "abcdefghijkl"[:number])
    (folder / "a.launch.yaml").write_text(f"launch:\n{nodes}", "utf-8")
    *shown, _, counted, _ = orchestra("a.launch.yaml").stdout.splitlines()
    assert counted == f"{number} notes"
    assert len(shown) == min(number, 11)
    assert shown[-1] == f"... and {last}: see --notes all" if last else "qq_arm_j" in shown[-1]


def test_what_is_nearly_the_name_of_something_that_is_here_is_no_note(
    orchestra: Command, folder: Path, prefix: Path
) -> None:
    (folder / "a.launch.yaml").write_text("launch: [node: {pkg: dmeo, exec: echo, name: $(env QQ_MODLE)}]\n")
    found = orchestra(".", "--format", "json", AMENT_PREFIX_PATH=str(prefix), QQ_MODEL="x")
    told = [(problem["severity"], problem["suggestion"]) for problem in json.loads(found.stdout)]
    assert (found.returncode, told) == (2, [("error", "demo"), ("error", "QQ_MODEL")])


def test_how_much_a_note_weighs_can_be_said(orchestra: Command, folder: Path) -> None:
    (folder / "a.launch.yaml").write_text("launch: [node: {pkg: qq_arm, exec: zzz}]\n")
    for level, status in (("off", 0), ("note", 0), ("warning", 0), ("error", 2)):
        found = orchestra(".", "--severity", f"ORC030={level}", "--format", "json")
        told = "".join(problem["severity"] for problem in json.loads(found.stdout))
        assert (found.returncode, told or "off") == (status, level)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("qqsocat", ("note", None)),  # words of their own, which a thousand programs may be near
        ("qqgzserver", ("note", None)),
        ("qqxarco", ("error", "qqxacro")),
        ("qqxacr", ("error", "qqxacro")),
        ("qqfs", ("note", None)),  # as ipfs is none of ipcs
        ("qqsc", ("error", "qqcs")),
    ],
)
def test_a_program_is_a_slip_only_for_one_that_a_single_slip_turns_into_it(
    orchestra: Command, folder: Path, tmp_path: Path, name: str, told: tuple[str, str | None]
) -> None:
    programs = tmp_path / "programs"
    programs.mkdir()
    for program in ("qqcat", "qqcs", "qqserialver", "qqxacro"):
        (programs / program).touch(0o755)
    (folder / "a.launch.yaml").write_text(f"launch: [log: {{message: $(command '{name} a.urdf')}}]\n")
    found = orchestra(".", "--format", "json", PATH=f"{programs}:/usr/bin:/bin")
    (problem,) = json.loads(found.stdout)
    assert (problem["code"], problem["severity"], problem["suggestion"]) == ("ORC031", *told)


def test_names_of_the_graph_that_a_command_asks_for_are_no_files(orchestra: Command, folder: Path) -> None:
    for command in ("ros2 param get --hide-type /robot_state_publisher robot_description", "qq_tool /map"):
        (folder / "a.launch.yaml").write_text(f"launch: [log: {{message: $(command '{command}')}}]\n")
        (problem,) = json.loads(orchestra(".", "--format", "json", PATH="/usr/bin:/bin").stdout)
        assert (problem["code"], problem["severity"]) == ("ORC031", "note")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("param get /robot_state_publisher robot_description", ("note", "which asks what runs")),
        ("topic echo --once /map", ("note", "which asks what runs")),
        (
            "pkg prefix demo",
            ("error", "ended with status 1"),
        ),  # what is installed is known before anything runs
    ],
)
def test_a_command_that_asks_what_runs_is_left_open(
    orchestra: Command, folder: Path, tmp_path: Path, words: str, told: tuple[str, str]
) -> None:
    """It would wait for what is not there, and fail: `check` does not run it."""
    programs = tmp_path / "programs"
    programs.mkdir()
    (programs / "ros2").write_text("#!/bin/sh\nexit 1\n")
    (programs / "ros2").chmod(0o755)
    (folder / "a.launch.yaml").write_text(f"launch: [log: {{message: $(command 'ros2 {words}')}}]\n")
    found = orchestra(".", "--format", "json", PATH=f"{programs}:/usr/bin:/bin")
    (problem,) = json.loads(found.stdout)
    assert (problem["code"], problem["severity"]) == ("ORC033", told[0])
    assert told[1] in problem["message"]


@pytest.mark.parametrize(
    ("code", "told"),
    [
        ("subprocess.run(['qq_xacro', 'a.xacro'])", ("note", "ORC031", None)),
        ("open('/qq_etc/robot/setup.yaml')", ("note", "ORC029", None)),
        ("os.listdir(os.path.expanduser('~/qq_maps'))", ("note", "ORC029", None)),
        ("open(os.path.join(os.path.dirname(__file__), 'setup.yaml'))", ("error", "ORC029", None)),
        (
            "open(os.path.join(os.path.dirname(__file__), '..', 'qq', 'setup.yaml'))",
            ("error", "ORC029", None),
        ),
        ("open('setup.yaml')", ("error", "ORC029", None)),
        ("open('QQ/machine/steup.yaml')", ("error", "ORC029", "QQ/machine/setup.yaml")),
        ("subprocess.run(['slepe', '1'])", ("error", "ORC031", "sleep")),
    ],
)
@pytest.mark.parametrize("late", [False, True])
def test_what_code_asks_the_machine_for_is_noted_and_what_it_asks_the_project_for_is_not(
    orchestra: Command, folder: Path, tmp_path: Path, code: str, told: tuple[str, str, str | None], late: bool
) -> None:
    """What is nearly the name of something that is there is no lack of the machine."""
    text = f"import os, subprocess\ndef asked(*_): {code}\n".replace("QQ", str(tmp_path))
    made = "OpaqueFunction(function=asked)" if late else "LogInfo(msg=str(asked()))"
    (tmp_path / "machine").mkdir()
    (tmp_path / "machine/setup.yaml").touch()
    (folder / "launch").mkdir()
    launch = folder / "launch/a.launch.py"
    launch.write_text(
        text + _PYTHON.replace("import IncludeL", "import OpaqueFunction, IncludeL") % ("", made)
    )
    (problem,) = json.loads(orchestra(str(launch), "--format", "json").stdout)
    severity, kind, meant = told
    meant = meant and meant.replace("QQ", str(tmp_path))
    assert (problem["severity"], problem["code"], problem["suggestion"]) == (severity, kind, meant)
    assert problem["line"] == 2


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.launch.yaml", "launch: [include: {file: QQ/steup.yaml}]\n"),
        ("a.launch.xml", '<launch><include file="QQ/steup.yaml"/></launch>\n'),
        ("b.launch.xml", "<launch><let name='a' value=\"$(file-content 'QQ/steup.yaml')\"/></launch>\n"),
        ("a.launch.py", _PYTHON % ("", "IncludeLaunchDescription('QQ/steup.yaml')")),
    ],
)
def test_a_file_of_the_machine_is_noted_until_it_is_nearly_one_that_is_there(
    orchestra: Command, orchestra_here: Command, folder: Path, tmp_path: Path, name: str, text: str
) -> None:
    """A plan needs it."""
    (folder / "inner").mkdir()
    file = folder / "inner" / name
    file.write_text(text.replace("QQ", str(tmp_path / "machine")))
    (told,) = json.loads(orchestra(str(file), "--format", "json").stdout)
    assert (told["severity"], told["code"], told["suggestion"]) == ("note", "ORC029", None)
    assert orchestra_here("plan", str(file)).returncode == 2
    (tmp_path / "machine").mkdir()
    (tmp_path / "machine/setup.yaml").touch()
    (told,) = json.loads(orchestra(str(file), "--format", "json").stdout)
    assert (told["severity"], told["suggestion"]) == ("error", str(tmp_path / "machine/setup.yaml"))


def test_a_file_that_is_there_from_the_folder_of_the_project_is_left_open(
    orchestra: Command, folder: Path
) -> None:
    """`ros2 launch` looks for it in the working directory, which is often the root of the repository."""
    project = folder / "project"
    (project / "launch").mkdir(parents=True)
    (project / "config").mkdir()
    (project / "config" / "robot.yaml").write_text("/**:\n  ros__parameters:\n    rate: 5\n")
    for name, severity in (("robot", "note"), ("lidars", "error")):
        given = f"- node: {{pkg: qq_none, exec: talker, name: a, param: [from: config/{name}.yaml]}}\n"
        (project / "launch" / "a.launch.yaml").write_text(f"launch:\n{given}")
        problems = json.loads(orchestra("project/launch/a.launch.yaml", "--format", "json").stdout)
        assert [problem["severity"] for problem in problems if problem["code"] == "ORC029"] == [severity]

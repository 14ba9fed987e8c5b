"""What launch files use of the commands of `ros2`: executables and files of packages."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.compat.ros2launch import api as launching
from orchestra.compat.ros2pkg import api as packages
from orchestra.compat.ros2run import api as running
from orchestra.errors import Code, Problems
from orchestra.pipeline import collect, inputs_from
from tests.compat.contexts import loading

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

_FILE = """\
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from ros2launch.api import get_share_file_path_from_package
from ros2run.api import get_executable_path

def generate_launch_description():
    talker = get_executable_path(package_name=PACKAGE, executable_name='talker')
    params = get_share_file_path_from_package(package_name='demo', file_name='params.yaml')
    return LaunchDescription([ExecuteProcess(cmd=[talker, params])])
"""


@pytest.fixture
def prefix(tmp_path: Path) -> Iterator[Path]:
    """The prefix of a package `demo`."""
    for folder in ("share/ament_index/resource_index/packages", "share/demo/config/b", "lib/demo/more"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "share/ament_index/resource_index/packages/demo").touch()
    for program in ("talker", "twice", "more/twice"):
        (tmp_path / "lib/demo" / program).write_text("#!/bin/sh\n", "utf-8")
        (tmp_path / "lib/demo" / program).chmod(0o755)
    (tmp_path / "lib/demo/notes.txt").touch()
    for file in ("params.yaml", "b/same.yaml", "same.yaml", "a.launch.py"):
        (tmp_path / "share/demo/config" / file).touch()
    with loading({"AMENT_PREFIX_PATH": str(tmp_path), "PATH": "/usr/bin:/bin"}):
        yield tmp_path


def test_executables_are_found_by_their_names(prefix: Path) -> None:
    talker = f"{prefix}/lib/demo/talker"
    assert running.get_executable_path(package_name="demo", executable_name="talker") == talker
    assert running.get_executable_path(package_name="demo", executable_name="notes.txt") is None
    with pytest.raises(running.MultipleExecutables) as error:
        running.get_executable_path(package_name="demo", executable_name="twice")
    assert error.value.paths == [f"{prefix}/lib/demo/more/twice", f"{prefix}/lib/demo/twice"]


def test_packages_are_found_by_their_names(prefix: Path) -> None:
    assert packages.get_prefix_path("demo") == str(prefix)
    assert packages.get_prefix_path("nothing_of_the_kind") is None
    assert "demo" in packages.get_package_names()
    with pytest.raises(packages.PackageNotFound):
        packages.get_executable_paths(package_name="nothing_of_the_kind")


def test_files_are_found_wherever_they_are_in_a_package(prefix: Path) -> None:
    share = f"{prefix}/share/demo/config"
    found = launching.get_share_file_path_from_package(package_name="demo", file_name="params.yaml")
    assert found == f"{share}/params.yaml"
    assert launching.get_launch_file_paths(path=share) == [f"{share}/a.launch.py"]
    with pytest.raises(FileNotFoundError):
        launching.get_share_file_path_from_package(package_name="demo", file_name="none.yaml")
    with pytest.raises(launching.MultipleLaunchFilesError) as error:
        launching.get_share_file_path_from_package(package_name="demo", file_name="same.yaml")
    assert error.value.paths == [f"{share}/b/same.yaml", f"{share}/same.yaml"]


def test_a_launch_file_starts_what_they_find(prefix: Path, tmp_path: Path) -> None:
    file = tmp_path / "a.launch.py"
    file.write_text(_FILE.replace("PACKAGE", "'demo'"), "utf-8")
    problems = Problems()
    plan = collect(str(file), inputs_from([], environment={"AMENT_PREFIX_PATH": str(prefix)}), problems)
    assert plan is not None
    assert list(problems) == []
    (process,) = plan.processes
    assert process.command == (
        f"{prefix}/lib/demo/talker",
        f"{prefix}/share/demo/config/params.yaml",
    )


def test_a_package_that_is_not_there_is_told_as_such(prefix: Path, tmp_path: Path) -> None:
    file = tmp_path / "a.launch.py"
    file.write_text(_FILE.replace("PACKAGE", "'nothing_of_the_kind'"), "utf-8")
    problems = Problems()
    collect(str(file), inputs_from([], environment={"AMENT_PREFIX_PATH": str(prefix)}), problems)
    (problem,) = problems
    assert (problem.code, problem.span and problem.span.line) == (Code.MISSING_PACKAGE, 7)

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.nearest import nearest
from orchestra.resolve.packages import InstalledPackages

if TYPE_CHECKING:
    from orchestra.resolve.context import Packages


def _ament_package(prefix: Path, name: str, *executables: str) -> None:
    marker = prefix / "share/ament_index/resource_index/packages" / name
    marker.parent.mkdir(parents=True, exist_ok=True)
    marker.touch()
    (prefix / "share" / name).mkdir()
    (prefix / "lib" / name).mkdir(parents=True)
    for executable in executables:
        path = prefix / "lib" / name / executable
        path.write_text("#!/bin/sh\n")
        path.chmod(0o755)


def _python_package(folder: Path, name: str, *nodes: str) -> Path:
    package = folder / name
    (package / "nodes").mkdir(parents=True)
    (package / "__init__.py").write_text("raise AssertionError('imported')\n")
    (package / "nodes/__init__.py").touch()
    for node in nodes:
        (package / "nodes" / f"{node}.py").touch()
    return package


@pytest.fixture
def on_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.syspath_prepend(str(tmp_path))
    return tmp_path


@pytest.mark.conforms("4.10 AMENT_PREFIX_PATH")
def test_the_index_of_every_prefix_is_read_in_order(tmp_path: Path) -> None:
    overlay, underlay = tmp_path / "overlay", tmp_path / "underlay"
    _ament_package(overlay, "demo", "talker")
    _ament_package(underlay, "demo", "talker", "listener")
    _ament_package(underlay, "base", "driver")
    packages: Packages = InstalledPackages({"AMENT_PREFIX_PATH": f"{overlay}:{tmp_path}/none::{underlay}"})
    assert packages.prefix("demo") == str(overlay)
    assert packages.share("demo") == str(overlay / "share/demo")
    assert packages.executable("demo", "talker") == (str(overlay / "lib/demo/talker"),)
    assert packages.executable("demo", "listener") is None
    assert packages.prefix("base") == str(underlay)
    assert packages.executables("base") == ("driver",)
    assert {"demo", "base"} <= set(packages.names())


def test_only_executable_files_are_executables(tmp_path: Path) -> None:
    _ament_package(tmp_path, "demo", "talker")
    (tmp_path / "lib/demo/readme").touch()
    (tmp_path / "lib/demo/folder").mkdir()
    packages = InstalledPackages({"AMENT_PREFIX_PATH": str(tmp_path)})
    assert packages.executable("demo", "readme") is None
    assert packages.executable("demo", "folder") is None
    assert packages.executables("demo") == ("talker",)


@pytest.mark.parametrize("name", ["", ".", "..", "a/b", "../packages", "no_such_package", "a-b"])
def test_an_unknown_package_is_none_everywhere(name: str) -> None:
    packages = InstalledPackages({})
    assert packages.prefix(name) is None
    assert packages.share(name) is None
    assert packages.executable(name, "x") is None
    assert packages.executables(name) == ()


def test_the_packages_of_the_wheels_are_found_without_the_variable() -> None:
    pytest.importorskip("rclpy", reason="needs ROS")
    packages = InstalledPackages({})
    assert packages.prefix("std_msgs") == sys.prefix
    assert packages.share("std_msgs") == str(Path(sys.prefix, "share/std_msgs"))
    assert nearest("std_msg", packages.names()) == "std_msgs"


def test_a_python_package_is_found_without_importing_it(on_path: Path) -> None:
    package = _python_package(on_path, "my_robot", "ekf", "driver")
    packages = InstalledPackages({})
    assert packages.share("my_robot") == str(package)
    assert packages.prefix("my_robot") == str(on_path)
    assert packages.executable("my_robot", "ekf") == (sys.executable, "-m", "my_robot.nodes.ekf")
    assert packages.executable("my_robot", "ekff") is None
    assert packages.executable("my_robot", "__init__") is None
    assert packages.executables("my_robot") == ("driver", "ekf")
    assert "my_robot" in packages.names()
    assert "my_robot" not in sys.modules


def test_the_source_of_an_ament_package_is_its_share_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """`pip install -e` copies no launch files anywhere: they stay beside the Python package."""
    root = tmp_path / "source"
    package = root / "my_robot"
    metadata = tmp_path / "site/my_robot-0.0.0.dist-info"
    for folder in (package, root / "resource", metadata):
        folder.mkdir(parents=True)
    (package / "__init__.py").touch()
    (metadata / "entry_points.txt").write_text("[console_scripts]\ntalker = my_robot.talker:main\n")
    monkeypatch.syspath_prepend(str(tmp_path / "site"))
    monkeypatch.syspath_prepend(str(root))
    (root / "package.xml").touch()
    assert InstalledPackages({}).share("my_robot") == str(package)
    assert "my_robot" not in InstalledPackages({}).names()
    (root / "resource/my_robot").touch()
    assert InstalledPackages({}).share("my_robot") == str(root)
    assert "my_robot" in InstalledPackages({}).names()


def test_a_node_that_is_a_package_is_run_by_its_main(on_path: Path) -> None:
    package = _python_package(on_path, "my_robot")
    (package / "nodes/ekf").mkdir()
    assert InstalledPackages({}).executable("my_robot", "ekf") is None
    (package / "nodes/ekf/__main__.py").write_text("print('runs')")
    (package / "__init__.py").write_text("")
    command = InstalledPackages({}).executable("my_robot", "ekf")
    assert command is not None
    assert subprocess.check_output(command, cwd=on_path, text=True) == "runs\n"


def test_an_executable_of_ament_comes_before_a_module(on_path: Path) -> None:
    _python_package(on_path, "my_robot", "ekf", "driver")
    _ament_package(on_path / "prefix", "my_robot", "ekf")
    packages = InstalledPackages({"AMENT_PREFIX_PATH": str(on_path / "prefix")})
    assert packages.executable("my_robot", "ekf") == (str(on_path / "prefix/lib/my_robot/ekf"),)
    assert packages.executable("my_robot", "driver") == (sys.executable, "-m", "my_robot.nodes.driver")
    assert packages.share("my_robot") == str(on_path / "prefix/share/my_robot")


def test_a_console_script_comes_before_a_module(on_path: Path) -> None:
    site = on_path / "site"
    _python_package(on_path, "my_robot", "ekf")
    metadata = on_path / "robots-1.0.dist-info"
    metadata.mkdir()
    (metadata / "entry_points.txt").write_text(
        "[other]\nekf = my_robot:no\n[console_scripts]\n# a comment\n"
        "ekf = my_robot.main:run [extra]\ngone=my_robot:x\nstray = elsewhere:x\n"
    )
    (metadata / "RECORD").write_text("site/bin/ekf,,\nmy_robot/ekf,,\n../scripts/ekf,sha256=x,1\n")
    script = on_path.parent / "scripts/ekf"
    script.parent.mkdir()
    script.write_text("#!/bin/sh\n")
    script.chmod(0o755)
    packages = InstalledPackages({})
    assert packages.executable("my_robot", "ekf") == (str(script),)
    assert packages.executables("my_robot") == ("ekf",)
    assert not site.exists()


def test_the_scripts_of_what_is_installed_here_are_found() -> None:
    command = InstalledPackages({}).executable("pytest", "pytest")
    assert command is not None
    assert "pytest" in subprocess.check_output([*command, "--version"], text=True)


@pytest.mark.parametrize("name", ["os", "json", "email", "__main__", "tests"])
def test_modules_and_mere_folders_are_no_packages(name: str) -> None:
    assert InstalledPackages({}).share(name) is None


def test_names_are_packages_to_launch_from_only() -> None:
    names = InstalledPackages({}).names()
    assert "bringup" in names
    assert not {"json", "yaml", "pydantic", "tests"} & set(names)

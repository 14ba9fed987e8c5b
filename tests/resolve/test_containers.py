"""Containers of Orchestra's own in the place of those of rclcpp_components, and what is told of components in Python."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING
from unittest.mock import Mock

import pytest

from orchestra.errors import Code
from orchestra.resolve.packages import components
from tests.plan.checks.told import marked
from tests.resolve.launching import Outcome, outcome

if TYPE_CHECKING:
    from pathlib import Path

_OWN = (sys.executable, "-m", "orchestra.ros.container")
_FILE = """launch:
- {container}:
    pkg: {package}
    exec: {executable}
    name: box
    namespace: ''
- load_composable_node:
    target: /box
    composable_node:
{components}
"""


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A package with components, one of them declared, that must not be imported."""
    path = tmp_path / "path"
    metadata = path / "demo_parts-1.0.dist-info"
    metadata.mkdir(parents=True)
    points = "[console_scripts]\ndemo = demo:main\n\n[rclpy_components]\ndemo::Talker = demo.talker:Talker [extra]\n"
    (metadata / "entry_points.txt").write_text(points, "utf-8")
    (path / "demo").mkdir()
    (path / "demo" / "__init__.py").touch()
    source = "raise SystemExit('user code is imported')\nclass Talker: ...\nif 1:\n    Other = Talker\n"
    (path / "demo" / "talker.py").write_text(source, "utf-8")
    (path / "demo" / "open.py").write_text("from demo.talker import *\n", "utf-8")
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(path)
    return tmp_path


def _planned(
    folder: Path,
    *plugins: str,
    package: str = "rclcpp_components",
    container: str = "node_container",
    executable: str = "component_container",
    launching: bool = True,
    prefix: Path | None = None,
) -> Outcome:
    written = "".join(
        f"    - {{pkg: demo, plugin: '{plugin}', name: n{n}}}\n" for n, plugin in enumerate(plugins)
    )
    text = _FILE.format(container=container, package=package, executable=executable, components=written)
    if not plugins:
        text = text.partition("- load_composable_node")[0]
    environment = {} if prefix is None else {"AMENT_PREFIX_PATH": str(prefix)}
    return outcome(folder, text, launching=launching, environment=environment)


@pytest.mark.parametrize("package", ["rclcpp_components", "rclpy_components", "orchestra"])
@pytest.mark.parametrize("container", ["node_container", "node"])
@pytest.mark.parametrize(
    "plugins", [(), ("demo.talker:Talker", "demo::Talker", "demo.talker:Other", "demo.open:Any")]
)
def test_components_in_python_are_loaded_into_a_container_of_ours(
    package: str, container: str, plugins: tuple[str, ...], folder: Path
) -> None:
    found = _planned(
        folder, *plugins, package=package, container=container, executable="component_container_mt"
    )
    assert not [*found.problems]
    assert found.process("/box").command[:4] == (*_OWN, "component_container_mt")
    assert found.process("/box").package == package


@pytest.mark.parametrize("launching", [True, False])
def test_a_component_in_cpp_needs_the_package(launching: bool, folder: Path) -> None:
    found = _planned(folder, "demo::Talker", "demo::Camera", "demo::Lidar", launching=launching)
    (problem,) = found.problems
    assert problem.code is Code.MISSING_PACKAGE
    assert problem.span is not None
    assert (problem.span.line, problem.span.column, problem.span.end_column) == (3, 10, 27)
    assert bool(found.problems.errors) == launching
    assert "components in Python: 'demo::Camera' and 1 more are not" in problem.notes[-1]
    assert found.process("/box").command[0].startswith("${prefix:rclcpp_components}/")


def test_what_distributions_declare_is_read_once(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    looking = Mock(wraps=components.declared_components)
    monkeypatch.setattr(components, "declared_components", looking)
    assert not [*_planned(folder, *["demo::Talker"] * 5).problems]
    looking.assert_called_once_with()


def test_an_installed_package_is_used_unless_it_cannot_load_what_is_asked(folder: Path) -> None:
    prefix = folder / "prefix"
    program = prefix / "lib" / "rclcpp_components" / "component_container"
    for path in (program, prefix / "share/ament_index/resource_index/packages/rclcpp_components"):
        path.parent.mkdir(parents=True)
        path.touch(mode=0o755)
    theirs = (str(program),)
    assert _planned(folder, prefix=prefix).process("/box").command[:1] == theirs
    assert _planned(folder, "demo::Talker", prefix=prefix).process("/box").command[:1] == theirs
    assert _planned(folder, "demo.talker:Talker", prefix=prefix).process("/box").command[:3] == _OWN
    mixed = _planned(folder, "demo.talker:Talker", "demo::Camera", prefix=prefix)
    assert mixed.process("/box").command[:1] == theirs


@pytest.mark.parametrize(
    ("plugin", "message", "meant"),
    [
        ("demo.talker:Taker", "module 'demo.talker' has no 'Taker'", "demo.talker:Talker"),
        ("demo.talker:Radio", "module 'demo.talker' has no 'Radio'", None),
        ("demo.taker:Talker", "there is no module 'demo.taker'", "demo.talker:Talker"),
        ("demmo.talker:Talker", "there is no module 'demmo'", "demo.talker:Talker"),
        ("demo::Talkre", "package 'demo' has no component 'demo::Talkre'", "demo::Talker"),
    ],
)
def test_a_component_that_is_not_there_is_told(
    plugin: str, message: str, meant: str | None, folder: Path
) -> None:
    found = _planned(folder, plugin, launching=False)
    (problem,) = found.problems.errors
    assert (problem.code, problem.message, problem.suggestion) == (Code.MISSING_EXECUTABLE, message, meant)
    assert problem.span is not None
    assert marked(problem.span).strip("'") == plugin


def test_a_component_that_another_package_registers_is_told_at_the_package(folder: Path) -> None:
    index = folder / "prefix/share/ament_index/resource_index"
    names = {"demo": "demo::Camera", "depth_demo": "depth_demo::Cloud"}
    for package, name in names.items():
        for kind, text in (("packages", ""), ("rclcpp_components", f"{name};lib/lib{package}.so\n")):
            (index / kind).mkdir(parents=True, exist_ok=True)
            (index / kind / package).write_text(text, "utf-8")
    found = _planned(folder, "demo::Camera", "depth_demo::Cloud", "other::Cloud", prefix=folder / "prefix")
    (problem,) = [item for item in found.problems if item.code is Code.MISSING_EXECUTABLE]
    assert problem.message == "package 'demo' has no component 'depth_demo::Cloud': 'depth_demo' has it"
    assert problem.suggestion == "depth_demo"
    assert problem.span is not None
    assert marked(problem.span) == "demo"


def test_a_module_that_another_machine_may_have_is_a_warning_where_nothing_is_started(folder: Path) -> None:
    (problem,) = _planned(folder, "elsewhere.parts:Part", launching=False).problems
    assert problem.message == "there is no module 'elsewhere' on this machine"
    (problem,) = _planned(folder, "elsewhere.parts:Part").problems.errors
    assert problem.message == "there is no module 'elsewhere'"


def test_a_component_without_a_name_has_that_of_its_class_as_its_id(folder: Path) -> None:
    text = "launch:\n- load_composable_node:\n    target: /box\n    composable_node: [{pkg: demo, plugin: PLUGIN}]\n"
    for plugin in ("demo.talker:Talker", "demo::Talker"):
        found = outcome(folder, text.replace("PLUGIN", f"'{plugin}'"))
        assert [component.id for component in found.plan.components] == ["/Talker"]


@pytest.mark.parametrize(
    ("plugin", "meant"),
    [("demo::RectifyNode", None), ("demo::RectifyNod", "demo::RectifyNode"), ("demo::Elsewhere", None)],
)
def test_a_slip_of_a_component_that_a_package_registers_is_told(
    plugin: str, meant: str | None, folder: Path
) -> None:
    index = folder / "prefix/share/ament_index/resource_index"
    for kind, text in (("packages", ""), ("rclcpp_components", "demo::RectifyNode;lib/librectify.so\n")):
        (index / kind).mkdir(parents=True)
        (index / kind / "demo").write_text(text, "utf-8")
    told = _planned(folder, plugin, launching=False, prefix=folder / "prefix").problems
    found = [problem.suggestion for problem in told if problem.code is Code.MISSING_EXECUTABLE]
    assert found == ([] if meant is None else [meant])

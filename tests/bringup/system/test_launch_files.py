"""What the launch files of the bringup come to: the same in every language, layers in their order, nothing wrong."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.plan.model import Plan, Process

_BRINGUP = Path(__file__).parents[3] / "bringup"
# What tells where something was written, and nothing of what runs.
_PLACES = {"location", "provenance", "file", "problems"}
_FILES = {
    "robot.yaml": ("namespace:=a",),
    "robot.launch.xml": ("namespace:=a",),
    "robot.launch.py": ("namespace:=a",),
    "fleet_robot.yaml": ("namespace:=a",),
    **{path.name: () for path in sorted(_BRINGUP.glob("*.launch.*")) if "two" in path.name},
    **dict.fromkeys(
        (
            *("one_robot.yaml", "two_robots.yaml", "fleet.yaml", "real_robot.yaml"),
            *("simulation.yaml", "lifecycle.yaml", "container.yaml"),
        ),
        (),
    ),
}


def _planned(name: str, *words: str) -> tuple[Plan, Problems]:
    problems = Problems()
    plan = collect(str(_BRINGUP / name), inputs_from(words, environment={"PATH": "/usr/bin:/bin"}), problems)
    assert plan is not None, list(problems)
    return plan, problems


def _processes(name: str, *words: str) -> Mapping[str, Process]:
    plan, problems = _planned(name, *words)
    assert not list(problems.errors)
    return {process.id: process for process in plan.processes}


def _without_places(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _without_places(item) for key, item in value.items() if key not in _PLACES}
    if isinstance(value, list | tuple):
        return [_without_places(item) for item in value]
    return value


def test_every_launch_file_is_looked_at_here() -> None:
    files = {
        path.name
        for path in _BRINGUP.iterdir()
        if path.suffix in (".yaml", ".xml") or ".launch." in path.name
    }
    assert files == set(_FILES)


@pytest.mark.parametrize("name", sorted(_FILES))
def test_nothing_is_wrong_with_a_launch_file(name: str) -> None:
    _, problems = _planned(name, *_FILES[name])
    assert [problem.message for problem in problems] == []


@pytest.mark.parametrize(
    "words", [(), ("world:=maze", "mode:=hold", "duration:=5", "use_sim_time:=false", "log_level:=debug")]
)
def test_the_two_robots_are_the_same_in_every_language(words: tuple[str, ...]) -> None:
    plans = [
        json.dumps(_without_places(encode(_planned(f"two_robots.{ending}", *words)[0])), default=str)
        for ending in ("yaml", "launch.xml", "launch.py")
    ]
    assert plans[0] == plans[1] == plans[2]


def test_as_many_robots_as_an_argument_names() -> None:
    found = _processes("fleet.yaml", "robots:=a,b , c")
    assert found["/simulation"].parameters["robots"] == ("a", "b", "c")
    assert sum(process.endswith("/velocity_controller") for process in found) == 3
    assert found["/c/ekf"].parameters["base_link_frame"] == "c/base_footprint"
    for process in found.values():
        assert process.parameters["use_sim_time"] is True


def test_robots_may_have_any_names_without_a_warning() -> None:
    """Parameters of single robots count only where somebody asks for them."""
    assert [problem.message for problem in _planned("fleet.yaml", "robots:=r1,r2,r3,r4,r5")[1]] == []
    own = _processes("fleet.yaml", f"settings:={_BRINGUP / 'params' / 'robots.yaml'}")
    assert own["/robot2/velocity_controller"].parameters["max_linear_vel"] == 0.4


def test_robots_start_and_drive_as_a_file_tells() -> None:
    file = str(_BRINGUP / "robots" / "three.yaml")
    found = _processes("fleet.yaml", f"robots_file:={file}", "mode:=linear")
    assert found["/simulation"].parameters["robots"] == ("robot1", "robot2", "robot3")
    assert found["/simulation"].parameters["robots_file"] == file
    modes = [found[f"/robot{number}/velocity_controller"].parameters["mode"] for number in (1, 2, 3)]
    assert modes == ["linear", "linear", "hold"]


def test_layers_of_parameters_overrule_each_other_in_their_order(tmp_path: Path) -> None:
    """Common, site, single robot, launch file."""
    own = tmp_path / "robots.yaml"
    own.write_text(
        "/robot2/velocity_controller:\n  ros__parameters: {max_linear_vel: 0.11, mode: hold}\n", "utf-8"
    )
    common = _processes("fleet.yaml", "robots:=robot1,robot2", "settings:=")
    site = _processes("fleet.yaml", "robots:=robot1,robot2", "settings:=", "site:=warehouse")
    single = _processes("fleet.yaml", "robots:=robot1,robot2", f"settings:={own}", "site:=warehouse")

    def speeds(found: Mapping[str, Process]) -> list[Any]:
        return [
            found[f"/{robot}/velocity_controller"].parameters["max_linear_vel"]
            for robot in ("robot1", "robot2")
        ]

    assert [speeds(each) for each in (common, site, single)] == [[0.5, 0.5], [0.7, 0.7], [0.7, 0.11]]
    assert single["/robot2/velocity_controller"].parameters["mode"] == "wander"


def test_a_real_robot_has_drivers_where_the_others_have_the_simulation() -> None:
    found = _processes("real_robot.yaml", "scan:=lidar/scan", "cmd_vel:=base/cmd_vel", "odometry:=base/odom")
    assert set(found) == {"/robot1/ekf", "/robot1/velocity_controller", "/robot1/command_arbiter"}
    assert all(process.parameters["use_sim_time"] is False for process in found.values())
    assert ("scan", "lidar/scan") in map(tuple, found["/robot1/velocity_controller"].remappings)
    assert ("wheel/odometry", "base/odom") in map(tuple, found["/robot1/ekf"].remappings)
    # The controller goes by way of the arbiter, which alone speaks to the base.
    assert ("cmd_vel", "cmd_vel_autonomy") in map(tuple, found["/robot1/velocity_controller"].remappings)
    assert ("cmd_vel", "base/cmd_vel") in map(tuple, found["/robot1/command_arbiter"].remappings)


def test_the_drivers_of_a_real_robot_are_a_launch_file(tmp_path: Path) -> None:
    drivers = tmp_path / "drivers.yaml"
    drivers.write_text(
        "launch:\n  - arg: {name: namespace}\n"
        "  - executable: {cmd: 'true', name: lidar_of_$(var namespace)}\n",
        "utf-8",
    )
    found = _processes("real_robot.yaml", f"drivers:={drivers}", "namespace:=r")
    assert "/r/ekf" in found
    assert "lidar_of_r" in found


def test_managed_controllers_wait_for_the_filter_of_their_robot() -> None:
    found = _processes("lifecycle.yaml")
    for robot in ("robot1", "robot2"):
        controller = found[f"/{robot}/velocity_controller"]
        assert controller.kind == "lifecycle_node"
        assert [(edge.process, edge.condition) for edge in controller.depends_on] == [
            (f"/{robot}/ekf", "ready")
        ]


def test_one_container_has_all_nodes() -> None:
    plan, _ = _planned("container.yaml")
    assert [process.id for process in plan.processes] == ["/everything"]
    assert [component.id for component in plan.components] == [
        "/simulation",
        *(f"/{robot}/{node}" for robot in ("robot1", "robot2") for node in ("ekf", "velocity_controller")),
    ]

"""Idioms of public launch files in Python, of drivers, simulators and vehicles: nothing is held against them."""

from __future__ import annotations

from textwrap import dedent
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.errors import Problem, Problems
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import encode
from tests.load.planning import installed

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path


def planned(
    folder: Path, text: str, *words: str, files: Mapping[str, str] | None = None, **variables: str
) -> tuple[dict[str, Any], list[Problem]]:
    """Return the plan of a launch file in the package `demo`, and what is held against it.

    `files` are others in its share folder, by their paths in it, `variables` are of the environment.
    """
    environment = {**installed(folder), **variables}
    share = folder / "prefix/share/demo"
    for name, content in {"launch/main.launch.py": text, **(files or {})}.items():
        path = share / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(dedent(content), "utf-8")
    problems = Problems()
    path = share / "launch/main.launch.py"
    plan = collect(str(path), inputs_from(words, environment=environment), problems)
    return {} if plan is None else encode(plan), list(problems)


def messages(content: Mapping[str, Any]) -> list[str]:
    """Return what is logged, in order."""
    return [step["message"] for trigger in content["triggers"] for step in trigger["do"]]


SHOWS_WORDS = """\
import sys
from launch import LaunchDescription
from launch.actions import LogInfo, OpaqueFunction
def found(context):
    return [LogInfo(msg=" ".join({words}))]
def generate_launch_description():
    return LaunchDescription([OpaqueFunction(function=found)])
"""


@pytest.mark.parametrize(
    "words",
    [
        "word for word in sys.argv if len(word.split(':=')) == 2",
        "sys.argv[4 - 1 :]",
        "list(sys.argv)[-2:]",
        "(sys.argv + [])[-2:]",
        "sys.argv.copy()[-2:]",
        "context.argv",
    ],
)
def test_arguments_that_code_takes_from_the_command_line_are_known(words: str, tmp_path: Path) -> None:
    content, problems = planned(tmp_path, SHOWS_WORDS.format(words=words), "hostname:=10.0.0.2", "port:=7")
    assert problems == []
    assert messages(content) == ["hostname:=10.0.0.2 port:=7"]


def test_an_argument_that_another_branch_of_the_code_may_read_is_known(tmp_path: Path) -> None:
    text = """\
    from launch import LaunchDescription
    from launch.actions import LogInfo, OpaqueFunction
    def chosen(context):
        configurations = context.launch_configurations
        return [LogInfo(msg=configurations["bag"] if "bag" in configurations else configurations["device"])]
    def generate_launch_description():
        return LaunchDescription([OpaqueFunction(function=chosen)])
    """
    content, problems = planned(tmp_path, text, "bag:=a.mcap", "device:=/dev/video0")
    assert (messages(content), problems) == (["a.mcap"], [])
    _, (problem,) = planned(tmp_path, text, "bag:=a.mcap", "devise:=/dev/video0")
    assert "no argument 'devise'" in problem.message


def test_a_condition_is_asked_by_the_name_that_it_has_upstream(tmp_path: Path) -> None:
    text = """\
    from launch import LaunchDescription, Substitution
    from launch.actions import DeclareLaunchArgument, LogInfo, OpaqueFunction
    from launch.conditions import IfCondition, LaunchConfigurationEquals, UnlessCondition
    from launch.substitutions import LaunchConfiguration, PythonExpression
    class Chosen(Substitution):
        def __init__(self, one, other, condition):
            self.text = one if condition else other
        def perform(self, context):
            return self.text
    def setup(context):
        stereo = PythonExpression(["'", LaunchConfiguration("stereo"), "' == 'true'"])
        held = [
            IfCondition(stereo)._predicate_func(context),
            UnlessCondition(stereo)._predicate_func(context),
            LaunchConfigurationEquals("stereo", "true")._predicate_func(context),
        ]
        return [
            DeclareLaunchArgument("depth", default_value=Chosen("false", "true", held[0])),
            LogInfo(msg=[LaunchConfiguration("depth"), str(held)]),
        ]
    def generate_launch_description():
        return LaunchDescription([
            DeclareLaunchArgument("stereo", default_value="true"), OpaqueFunction(function=setup)
        ])
    """
    content, problems = planned(tmp_path, text)
    assert (messages(content), problems) == (["false[True, False, True]"], [])


WRITES_LAUNCH_FILES = """\
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, GroupAction, IncludeLaunchDescription
from launch.actions import RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
def generate_launch_description():
    written = PathJoinSubstitution([LaunchConfiguration("setup_path"), "robot.launch.py"])
    generator = ExecuteProcess(cmd=["generate", LaunchConfiguration("setup_path")])
    robot = GroupAction([
        IncludeLaunchDescription(PythonLaunchDescriptionSource([written]), launch_arguments=[("a", "b")]),
        Node(package="demo", executable="tool"),
    ])
    return LaunchDescription([
        DeclareLaunchArgument("setup_path"), generator,
        RegisterEventHandler(OnProcessExit(target_action=generator, on_exit=[robot])),
    ])
"""


def test_a_launch_file_that_a_process_of_the_run_writes_is_read_when_it_is_wanted(tmp_path: Path) -> None:
    setup = tmp_path / "setup"
    content, problems = planned(tmp_path, WRITES_LAUNCH_FILES, f"setup_path:={setup}")
    assert problems == []
    (trigger,) = content["triggers"]
    assert [step["action"] for step in trigger["do"]] == ["deferred", "start"]
    assert trigger["deferred"]


@pytest.mark.parametrize("place", ["launch/setup", "prefix/share/other"], ids=["beside", "in-a-package"])
def test_a_launch_file_that_no_process_writes_is_missed(place: str, tmp_path: Path) -> None:
    setup = tmp_path / ("prefix/share/demo/" + place if place.startswith("launch") else place)
    _, (problem,) = planned(tmp_path, WRITES_LAUNCH_FILES, f"setup_path:={setup}")
    assert "there is no launch file" in problem.message


@pytest.mark.parametrize(
    ("rest", "events"),
    [
        ("LogInfo(msg='started')", ["run_started"]),
        (
            "RegisterEventHandler(OnProcessExit(target_action=ports, on_exit=lambda event, context: None))",
            ["process_output", "process_output", "process_exited"],
        ),
    ],
    ids=["nobody", "code"],
)
def test_output_is_only_kept_for_code_that_may_ask_for_it(
    rest: str, events: list[str], tmp_path: Path
) -> None:
    text = f"""\
    from launch import LaunchDescription
    from launch.actions import ExecuteProcess, LogInfo, RegisterEventHandler
    from launch.event_handlers import OnProcessExit
    def generate_launch_description():
        ports = ExecuteProcess(cmd=[["socat ", "-d ", "pty"]], shell=True, cached_output=True)
        return LaunchDescription([ports, {rest}])
    """
    content, problems = planned(tmp_path, text)
    assert ([trigger["on"]["event"] for trigger in content["triggers"]], problems) == (events, [])


def test_an_include_that_is_not_made_may_have_an_argument_of_nothing(tmp_path: Path) -> None:
    text = """\
    from launch import LaunchDescription
    from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, LogInfo
    from launch.conditions import IfCondition
    from launch.substitutions import LaunchConfiguration, PythonExpression, ThisLaunchFileDir
    MODELS = {"oak": "OAK-D"}
    def generate_launch_description():
        sensor = LaunchConfiguration("sensor")
        is_oak = PythonExpression(["'", sensor, "' in ", str(list(MODELS))])
        return LaunchDescription([
            DeclareLaunchArgument("sensor", default_value="lidar"),
            IncludeLaunchDescription(
                [ThisLaunchFileDir(), "/shown.launch.xml"],
                launch_arguments={"model": MODELS.get(sensor)}.items(),
                condition=IfCondition(is_oak),
            ),
            LogInfo(msg=sensor),
        ])
    """
    files = {"launch/shown.launch.xml": '<launch><arg name="model"/></launch>'}
    content, problems = planned(tmp_path, text, files=files)
    assert (messages(content), problems) == (["lidar"], [])
    _, (problem,) = planned(tmp_path, text, "sensor:=oak", files=files)
    assert "model: expected a text" in problem.message
    assert problem.span is not None
    assert problem.span.line == 13


SETTINGS = """\
import tempfile
import yaml
from launch import SomeSubstitutionsType, Substitution
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.substitutions import LaunchConfiguration
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

def values(path):
    with open(path) as file:
        return yaml.safe_load(file)["/**"]["ros__parameters"]

class Declared(GroupAction):
    def __init__(self, name: str, file: SomeSubstitutionsType, **kwargs):
        self.name, self.file = name, normalize_to_list_of_substitutions(file)
        super().__init__(actions=[DeclareLaunchArgument(name, default_value=self.file)], scoped=False, **kwargs)
    def execute(self, context):
        file = perform_substitutions(context, self.file)
        own = [DeclareLaunchArgument(name, default_value=str(value)) for name, value in values(file).items()]
        self._GroupAction__actions = [DeclareLaunchArgument(self.name, default_value=file), *own]
        return super().execute(context)

class Merged(Substitution):
    def __init__(self, name, file):
        super().__init__()
        self.name, self.file = name, normalize_to_list_of_substitutions(file)
    def perform(self, context):
        found = values(perform_substitutions(context, self.file))
        found = {name: type(value)(context.launch_configurations.get(name, value)) for name, value in found.items()}
        found |= values(LaunchConfiguration(self.name).perform(context)) if context.launch_configurations["own"] else {}
        content = {"/**": {"ros__parameters": found}}
        context.launch_configurations.update(content)
        with tempfile.NamedTemporaryFile(mode="w", delete=False) as file:
            yaml.dump(content, file)
        return file.name
"""


@pytest.mark.parametrize(
    ("words", "parameters"),
    [
        ([], {"frame": "base", "rate": 10}),
        (["rate:=20"], {"frame": "base", "rate": 20}),
        (["rate:=20", "own:=yes", "settings:={share}/own.yaml"], {"frame": "map", "rate": 20, "more": 1.5}),
    ],
    ids=["the file's", "from the command line", "another file over them"],
)
def test_settings_of_a_file_become_arguments_and_parameters(
    words: list[str], parameters: dict[str, Any], tmp_path: Path
) -> None:
    text = """\
    import os, sys
    sys.path.append(os.path.dirname(__file__))
    from ament_index_python.packages import get_package_share_directory
    from launch import LaunchDescription
    from launch.actions import DeclareLaunchArgument
    from launch.substitutions import PathJoinSubstitution
    from launch_ros.actions import Node
    from settings import Declared, Merged
    def generate_launch_description():
        file = PathJoinSubstitution([get_package_share_directory("demo"), "default.yaml"])
        return LaunchDescription([
            DeclareLaunchArgument("own", default_value=""),
            Declared("settings", file),
            Node(package="demo", executable="tool", name="driver", parameters=[Merged("settings", file)]),
        ])
    """
    files = {
        "launch/settings.py": SETTINGS,
        "default.yaml": "/**: {ros__parameters: {frame: base, rate: 10}}",
        "own.yaml": "/**: {ros__parameters: {frame: map, more: 1.5}}",
    }
    share = str(tmp_path / "prefix/share/demo")
    content, problems = planned(tmp_path, text, *(word.format(share=share) for word in words), files=files)
    assert problems == []
    assert content["processes"][0]["parameters"] == parameters
    assert [argument["name"] for argument in content["arguments"]] == ["own", "settings", "frame", "rate"]


def test_what_an_option_passes_on_is_one_word(tmp_path: Path) -> None:
    """The spawner of ros2_control takes the arguments for a controller as one; others stand apart."""
    text = """\
        from launch import LaunchDescription
        from launch_ros.actions import Node
        def generate_launch_description():
            return LaunchDescription([
                Node(package="demo", executable="talker", arguments=[
                    "arm", "--controller-ros-args", "--ros-args --remap ~/states:=/joint_states"]),
                Node(package="demo", executable="talker", arguments=["--verbose", "--ros-args --log-level debug"]),
            ])
        """
    _, problems = planned(tmp_path, text)
    (problem,) = [problem for problem in problems if "is one word" in problem.message]
    assert "--log-level" in problem.message


def test_a_missing_comma_before_an_option_is_told_alone(tmp_path: Path) -> None:
    """What the option passes on is not told to be several words: put apart, they would be the spawner's own."""
    text = """\
        from launch import LaunchDescription
        from launch_ros.actions import Node
        def generate_launch_description():
            return LaunchDescription([
                Node(package="demo", executable="talker", arguments=[
                    "-c", "/robot/manager"
                    "--controller-ros-args",
                    "-r /robot/wheels/cmd_vel:=/robot/cmd_vel"]),
            ])
        """
    _, problems = planned(tmp_path, text)
    (problem,) = [problem for problem in problems if "word" in problem.message]
    assert problem.message.startswith("a comma is missing")

"""Python launch files with some nodes, written as people do: each written out, in loops, by helpers, in groups."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from benchmarks import levels

_PYTHON: Final = """\
import os

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, IncludeLaunchDescription, OpaqueFunction
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushRosNamespace, SetParameter

FOLDER = os.path.dirname(__file__)
"""
_DECLARED: Final = """\
        DeclareLaunchArgument("robot", default_value="nobody"),
        DeclareLaunchArgument("mode", default_value="sim", description="sim, or the real one"),
        DeclareLaunchArgument("debug", default_value="false"),
"""
_DIRECT: Final = """\


def generate_launch_description():
    robot = LaunchConfiguration("robot")
    return LaunchDescription([
{actions}    ])
"""
_CALL: Final = """\
Node(
            package="benchmark_widget", executable="widget", name={name}, namespace=robot,
            parameters=[{{"rate": {number} + 0.5, "frame": [robot, {frame}]}}],
            remappings=[("scan", {scan}), ("odom", ["/", robot, "/odom"])],
        )"""
_NUMBERED: Final = _CALL.format(name='f"widget{n}"', number="n", frame='f"/base{n}"', scan='f"scan{n}"')
LOOP: Final = f"""\


def generate_launch_description():
    robot = LaunchConfiguration("robot")
    description = LaunchDescription([
{_DECLARED}    ])
    for n in range({{first}}, {{end}}):
        description.add_action({_NUMBERED})
    return description
"""
_HELPER: Final = f"""\


def widget(robot, n, **more):
    return {_NUMBERED}


def generate_launch_description():
    robot = LaunchConfiguration("robot")
    return LaunchDescription([
{_DECLARED}{{calls}}    ])
"""
OPAQUE: Final = f"""\


def widgets(context):
    robot = LaunchConfiguration("robot").perform(context)
    return [
        {_NUMBERED}
        for n in range({{first}}, {{end}})
    ]


def generate_launch_description():
    return LaunchDescription([
{_DECLARED}        OpaqueFunction(function=widgets),
    ])
"""
_PYTHON_GROUP: Final = """\
        GroupAction(condition=UnlessCondition(LaunchConfiguration("debug")), actions=[
            PushRosNamespace(robot),
            SetParameter("use_sim_time", True),
{actions}        ]),
"""
_PYTHON_GROUPED: Final = """\
            Node(
                package="benchmark_widget",
                executable="widget",
                name="widget{n}",
                output="screen",
                respawn=True,
                respawn_delay=2.0,
                condition=IfCondition(LaunchConfiguration("used", default="true")),
                parameters=[{{"frame": [robot, "/base{n}"]}}],
                arguments=["--ros-args", "--log-level", "info"],
                remappings=[("/tf", "tf"), ("/tf_static", "tf_static")],
            ),
"""
_INCLUDE: Final = """\
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(os.path.join(FOLDER, "{file}")),
            launch_arguments={{"robot": "{robot}", "mode": LaunchConfiguration("mode")}}.items(),
        ),
"""


def including(files: Iterable[levels.File]) -> str:
    """Return a file that includes others, and hands its arguments on."""
    return _described(_DECLARED + "".join(_INCLUDE.format(file=file, robot=robot) for file, robot in files))


def _described(actions: str) -> str:
    return _PYTHON + _DIRECT.format(actions=actions)


def written_out(numbers: Sequence[int]) -> str:
    """Return a file in which each node is written out."""
    calls = "".join(
        f"        {_CALL},\n".format(name=f'"widget{n}"', number=n, frame=f'"/base{n}"', scan=f'"scan{n}"')
        for n in numbers
    )
    return _described(_DECLARED + calls)


def ranged(text: str) -> Callable[[Sequence[int]], str]:
    """Return what writes nodes by a text in which they are numbers of a range."""
    return lambda numbers: (
        _PYTHON + text.replace("{first}", str(numbers[0])).replace("{end}", str(numbers[-1] + 1))
    )


def helped(numbers: Sequence[int]) -> str:
    """Return a file in which a function makes each node."""
    return _PYTHON + _HELPER.replace("{calls}", "".join(f"        widget(robot, {n}),\n" for n in numbers))


def grouped(numbers: Sequence[int]) -> str:
    """Return a file in which all nodes are in a group, each with a condition."""
    actions = "".join(_PYTHON_GROUPED.format(n=n) for n in numbers)
    return _described(_DECLARED + _PYTHON_GROUP.format(actions=actions))

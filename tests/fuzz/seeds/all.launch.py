"""Most classes once, for mutations."""

from launch import LaunchDescription
from launch.actions import (
    DeclareLaunchArgument,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    SetEnvironmentVariable,
    TimerAction,
)
from launch.conditions import IfCondition, UnlessCondition
from launch.event_handlers import OnProcessExit
from launch.substitutions import (
    EnvironmentVariable,
    LaunchConfiguration,
    PathJoinSubstitution,
    PythonExpression,
    ThisLaunchFileDir,
)
from launch_ros.actions import Node, PushRosNamespace, SetParameter


def made(context):
    name = LaunchConfiguration("name").perform(context)
    return [Node(executable="/bin/sh", name=name, parameters=[{"rate": 1.5, "words": ["a", "b"]}])]


def generate_launch_description():
    shell = ExecuteProcess(cmd=["/bin/sh", "-c", "exit 0"], name="shell", output="screen")
    return LaunchDescription(
        [
            DeclareLaunchArgument("name", default_value="talker", choices=["talker", "listener"]),
            SetEnvironmentVariable("X", EnvironmentVariable("HOME", default_value="none")),
            SetParameter(name="use_sim_time", value=True),
            GroupAction(
                [
                    PushRosNamespace(LaunchConfiguration("name")),
                    Node(
                        executable="/bin/sh",
                        name="n",
                        condition=IfCondition(
                            PythonExpression(["'", LaunchConfiguration("name"), "' == 'talker'"])
                        ),
                        remappings=[("a", "b"), ("/c", "d")],
                        parameters=[
                            PathJoinSubstitution([ThisLaunchFileDir(), "params", "nodes.yaml"]),
                            {"p": [1, 2]},
                        ],
                        ros_arguments=["--log-level", "info"],
                    ),
                ],
                condition=UnlessCondition("false"),
            ),
            shell,
            RegisterEventHandler(OnProcessExit(target_action=shell, on_exit=[LogInfo(msg="over")])),
            TimerAction(period=1.0, actions=[LogInfo(msg=["a", LaunchConfiguration("name")])]),
            OpaqueFunction(function=made),
            IncludeLaunchDescription(
                PathJoinSubstitution([ThisLaunchFileDir(), "inner.launch.xml"]),
                launch_arguments={"name": "b"}.items(),
            ),
        ]
    )

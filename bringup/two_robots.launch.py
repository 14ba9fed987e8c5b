"""Two robots in one MuJoCo world, each with its own filter and controller.

orchestra launch bringup/two_robots.launch.py world:=maze duration:=60
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, LaunchLogDir
from launch_ros.actions import Node
from launch_ros.descriptions import ParameterValue


def generate_launch_description() -> LaunchDescription:
    """Describe it as `two_robots.yaml` does."""
    return LaunchDescription([*arguments(), simulation(), robots()])


def arguments() -> list[DeclareLaunchArgument]:
    """Return what can be said on the command line."""
    return [
        DeclareLaunchArgument(
            "world",
            default_value="arena",
            choices=["arena", "maze", "corridor", "warehouse"],
            description="Which world to build.",
        ),
        DeclareLaunchArgument(
            "seed", default_value="1", description="Where the obstacles stand and how the sensors err."
        ),
        DeclareLaunchArgument("headless", default_value="true", description="Run without a window."),
        DeclareLaunchArgument(
            "use_sim_time", default_value="true", description="Let all nodes follow the simulation's clock."
        ),
        DeclareLaunchArgument(
            "duration",
            default_value="0.0",
            description="Length of the run in simulated seconds, 0 for endless.",
        ),
        DeclareLaunchArgument(
            "speed", default_value="1.0", description="Speed of the simulation relative to real time."
        ),
        DeclareLaunchArgument(
            "mode",
            default_value="wander",
            choices=["wander", "linear", "rotational", "hold", "go_to_goal"],
            description="How the robots drive.",
        ),
        DeclareLaunchArgument(
            "log_level",
            default_value="info",
            choices=["debug", "info", "warn", "error", "fatal"],
            description="Least severity that the nodes print.",
        ),
        DeclareLaunchArgument(
            "record",
            default_value="",
            description="Film (.mp4) or last view (.png) of the world, rendered where a GL library is there.",
        ),
        DeclareLaunchArgument(
            "picture",
            default_value=[LaunchLogDir(), "/two_robots.png"],
            description="Where the picture of the driven paths is written when the run ends.",
        ),
    ]


def simulation() -> Node:
    """Return the world."""
    return Node(
        package="bringup",
        executable="simulation",
        name="simulation",
        namespace="/",
        parameters=[
            "params/simulation.yaml",
            {
                "use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool),
                "world": LaunchConfiguration("world"),
                "seed": ParameterValue(LaunchConfiguration("seed"), value_type=int),
                "headless": ParameterValue(LaunchConfiguration("headless"), value_type=bool),
                "duration": ParameterValue(LaunchConfiguration("duration"), value_type=float),
                "speed": ParameterValue(LaunchConfiguration("speed"), value_type=float),
                "picture": ParameterValue(LaunchConfiguration("picture"), value_type=str),
                "record": ParameterValue(LaunchConfiguration("record"), value_type=str),
            },
        ],
        ros_arguments=["--log-level", LaunchConfiguration("log_level")],
        required=True,  # its end, after `duration`, ends the run
        # Not where it fails at its start.
        restart={"policy": "on-failure", "delay": 1.0, "budget": 0},
        ready={"message": "/clock", "timeout": 60.0},
    )


def robots() -> IncludeLaunchDescription:
    """Return the nodes of each robot, once the world is there."""
    return IncludeLaunchDescription(
        AnyLaunchDescriptionSource("robot.launch.py"),
        launch_arguments={
            "namespace": LaunchConfiguration("robot"),
            "use_sim_time": LaunchConfiguration("use_sim_time"),
            "mode": LaunchConfiguration("mode"),
            "log_level": LaunchConfiguration("log_level"),
        }.items(),
        for_each={"robot": ["robot1", "robot2"]},
        depends_on=[{"node": "/simulation", "condition": "ready"}],
    )

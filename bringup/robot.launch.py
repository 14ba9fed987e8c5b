"""One robot: its filter and its controller, below a namespace that also marks its frames."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node, PushROSNamespace
from launch_ros.descriptions import ParameterValue


def generate_launch_description() -> LaunchDescription:
    """Describe it as `robot.yaml` does."""
    robot = GroupAction(
        actions=[PushROSNamespace(LaunchConfiguration("namespace")), ekf(), velocity_controller()]
    )
    return LaunchDescription([*arguments(), robot])


def arguments() -> list[DeclareLaunchArgument]:
    """Return what whoever includes this has to say, and can say."""
    return [
        DeclareLaunchArgument("namespace", description="Namespace of the robot and prefix of its frames."),
        DeclareLaunchArgument(
            "use_sim_time", default_value="false", description="Follow /clock instead of the machine's time."
        ),
        DeclareLaunchArgument(
            "mode",
            default_value="wander",
            choices=["wander", "linear", "rotational", "hold", "go_to_goal"],
            description="How the robot drives.",
        ),
        DeclareLaunchArgument(
            "log_level", default_value="info", description="Least severity that the nodes print."
        ),
    ]


def ekf() -> Node:
    """Return the filter."""
    return Node(
        package="bringup",
        executable="ekf",
        name="ekf",
        parameters=[
            "params/ekf.yaml",
            {
                "use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool),
                "odom_frame": [LaunchConfiguration("namespace"), "/odom"],
                "world_frame": [LaunchConfiguration("namespace"), "/odom"],
                "base_link_frame": [LaunchConfiguration("namespace"), "/base_footprint"],
            },
        ],
        ros_arguments=["--log-level", LaunchConfiguration("log_level")],
        # The robot stands before it is driven again.
        restart={"policy": "on-failure", "delay": 1.0},
    )


def velocity_controller() -> Node:
    """Return what drives the robot."""
    return Node(
        package="bringup",
        executable="velocity_controller",
        name="velocity_controller",
        parameters=[
            "params/velocity_controller.yaml",
            {
                "use_sim_time": ParameterValue(LaunchConfiguration("use_sim_time"), value_type=bool),
                "mode": LaunchConfiguration("mode"),
            },
        ],
        ros_arguments=["--log-level", LaunchConfiguration("log_level")],
        # The robot stands before it is driven again.
        restart={"policy": "on-failure", "delay": 1.0},
    )

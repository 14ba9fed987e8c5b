"""A tree of launch files of every language, as a workspace has them, for `orchestra check`."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

_YAML = """\
launch:
  - arg: {{name: robot, default: robot{n}}}
  - arg: {{name: rate, default: "{n}.5", description: how often something is told}}
  - let: {{name: frame, value: $(var robot)/odom}}
  - group:
      - push_ros_namespace: {{namespace: $(var robot)}}
      - set_parameter: {{name: use_sim_time, value: true}}
      - executable: {{cmd: "/bin/echo $(var frame)", name: hello{n}, output: screen}}
      - executable:
          cmd: /bin/sleep $(var rate)
          name: sleeper
          if: $(eval "'$(var robot)' != 'nobody'")
          env: [{{name: LEVEL, value: "{n}"}}]
  - include:
      file: $(dirname)/../shared/driver{shared}.launch.xml
      arg: [{{name: device, value: /dev/ttyUSB{n}}}, {{name: namespace, value: $(var robot)}}]
"""
_XML = """\
<launch>
  <arg name="robot" default="robot{n}"/>
  <arg name="debug" default="false" description="whether to tell more"/>
  <let name="frame" value="$(var robot)/base"/>
  <group>
    <push_ros_namespace namespace="$(var robot)"/>
    <executable cmd="/bin/echo $(var frame)" name="hello" output="screen" if="$(var debug)"/>
    <node pkg="bringup" exec="ekf" name="ekf{n}">
      <param from="$(dirname)/../shared/params{shared}.yaml"/>
      <param name="frequency" value="2{n}.0"/>
      <remap from="odom" to="odom{n}"/>
    </node>
  </group>
  <include file="$(dirname)/../shared/tools{shared}.launch.yaml">
    <arg name="topic" value="/robot{n}/scan"/>
  </include>
</launch>
"""
_PYTHON = """\
import os

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import AnyLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node, PushRosNamespace


def generate_launch_description():
    shared = os.path.join(os.path.dirname(__file__), "..", "shared")
    robot = LaunchConfiguration("robot")
    return LaunchDescription([
        DeclareLaunchArgument("robot", default_value="robot{n}", description="which one"),
        DeclareLaunchArgument("slam", default_value="false", choices=["true", "false"]),
        PushRosNamespace(robot),
        ExecuteProcess(cmd=["/bin/echo", robot], output="screen", condition=IfCondition(LaunchConfiguration("slam"))),
        Node(
            package="bringup", executable="ekf", name="ekf{n}",
            parameters=[os.path.join(shared, "params{shared}.yaml"), {{"frequency": 2{n}.0, "world_frame": robot}}],
            remappings=[("odom", "odom{n}")],
        ),
        IncludeLaunchDescription(
            AnyLaunchDescriptionSource(PathJoinSubstitution([shared, "tools{shared}.launch.yaml"])),
            launch_arguments={{"topic": ["/", robot, "/scan"]}}.items(),
        ),
    ])
"""
_DRIVER = """\
<launch>
  <arg name="device"/>
  <log message="$(var device)"/>
  <arg name="namespace" default=""/>
  <group>
    <push_ros_namespace namespace="$(var namespace)"/>
    <node pkg="bringup" exec="velocity_controller" name="driver{n}">
      <param name="mode" value="wander" type="str"/>
      <param from="driving{n}.yaml"/>
    </node>
  </group>
</launch>
"""
_TOOLS = """\
launch:
  - arg: {{name: topic}}
  - executable: {{cmd: /bin/echo $(var topic), name: tool{n}}}
"""
_PARAMETERS = """\
/**:
  ros__parameters:
    frequency: {n}0.0
    two_d_mode: true
    odom0: wheel/odometry
    odom0_config: [false, false, false, false, false, false, true, true, false,
                   false, false, false, false, false, false]
"""
_DRIVING = """\
/**:
  ros__parameters:
    max_linear_vel: 0.2{n}
"""
# So many packages are included by all others, where there are others enough.
_SHARED = 20
_INCLUDING = 7


def write_tree(folder: Path, files: int) -> list[Path]:
    """Write a tree with so many launch files: two fifths YAML, the rest XML and Python; return their paths."""
    written = []
    shared = folder / "shared"
    shared.mkdir(parents=True, exist_ok=True)
    packages = max(1, min(_SHARED, files // _INCLUDING))
    for n in range(packages):
        (shared / f"params{n}.yaml").write_text(_PARAMETERS.format(n=n + 1))
        (shared / f"driving{n}.yaml").write_text(_DRIVING.format(n=n))
        for name, text in ((f"driver{n}.launch.xml", _DRIVER), (f"tools{n}.launch.yaml", _TOOLS)):
            (shared / name).write_text(text.format(n=n))
            written.append(shared / name)
    kinds = ((".yaml", _YAML), (".xml", _XML), (".py", _PYTHON), (".yaml", _YAML), (".xml", _XML))
    for n in range(files - len(written)):
        ending, text = kinds[n % len(kinds)]
        path = folder / f"part{n % 25}" / f"robot{n}.launch{ending}"
        path.parent.mkdir(exist_ok=True)
        path.write_text(text.format(n=n, shared=n // 5 % packages))
        written.append(path)
    return written

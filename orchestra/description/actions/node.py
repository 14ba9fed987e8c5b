"""`node`: starts a ROS node."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.fields import Argv, Text
from orchestra.description.parts import Param, Remap
from orchestra.description.running import Running


class Node(Running):
    """Start a ROS node."""

    pkg: Text | None = Field(default=None, description="Package of the executable.")
    exec: Text = Field(description="Executable in the package; without `pkg` a program.")
    namespace: Text | None = Field(
        default=None, description="Namespace; a relative one is put below the pushed one."
    )
    exec_name: Text | None = Field(default=None, description="Label of the process.")
    args: Argv | None = Field(default=None, description="Arguments of the program.")
    ros_args: Argv | None = Field(default=None, description="More arguments after --ros-args.")
    param: tuple[Param, ...] = Field(
        default=(), description="Parameters and parameter files, later ones win."
    )
    remap: tuple[Remap, ...] = Field(default=(), description="Remappings, the first that matches counts.")

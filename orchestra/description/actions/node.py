"""`node`: starts a ROS node."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, PlainValidator

from orchestra.description.fields import Argv, Text, word, worded
from orchestra.description.parts import Param, Remap
from orchestra.description.running import Running
from orchestra.description.text import Template

REACHED = ("active",)


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
    params_schema: Text | None = Field(
        default=None,
        description="What declares its parameters: a JSON Schema file, a definition file of"
        " generate_parameter_library, or a pydantic model (`module:Class`).",
    )
    lifecycle: Annotated[Template, PlainValidator(word(*REACHED)), worded(*REACHED)] | None = Field(
        default=None,
        description="The state that a lifecycle node is brought to, and back to when it restarts.",
    )
    remap: tuple[Remap, ...] = Field(default=(), description="Remappings, the first that matches counts.")

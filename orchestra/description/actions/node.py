"""`node`: starts a ROS node."""

from __future__ import annotations

from collections.abc import Collection
from typing import Annotated, Any

from orchestra.description.conflict import Conflict
from orchestra.description.fields import Argv, Text, word, worded
from orchestra.description.marks import Plain
from orchestra.description.model import field
from orchestra.description.parts import Param, Remap
from orchestra.description.running import Running
from orchestra.description.text import Template

REACHED = ("active",)
# What may be started instead of an executable.
INSTEAD = ("module", "script")


class Node(Running):
    """Start a ROS node."""

    pkg: Text | None = field(default=None, description="Package of the executable.")
    exec: Text | None = field(description="Executable in the package; without `pkg` a program.")
    module: Text | None = field(
        default=None,
        description="Python module that is run as `python -m` does, instead of `pkg` and `exec`.",
    )
    script: Text | None = field(
        default=None, description="Python file that is run, relative to the launch file, instead of `exec`."
    )
    namespace: Text | None = field(
        default=None, description="Namespace; a relative one is put below the pushed one."
    )
    exec_name: Text | None = field(default=None, description="Label of the process.")
    args: Argv | None = field(default=None, description="Arguments of the program.")
    ros_args: Argv | None = field(default=None, description="More arguments after --ros-args.")
    param: tuple[Param, ...] = field(
        default=(), description="Parameters and parameter files, later ones win."
    )
    params_schema: Text | None = field(
        default=None,
        description="What declares its parameters: a JSON Schema file, a definition file of"
        " generate_parameter_library, or a pydantic model (`module:Class`).",
    )
    lifecycle: Annotated[Template, Plain(word(*REACHED)), worded(*REACHED)] | None = field(
        default=None,
        description="The state that a lifecycle node is brought to, and back to when it restarts.",
    )
    remap: tuple[Remap, ...] = field(default=(), description="Remappings, the first that matches counts.")

    def conflict(self) -> Conflict | None:
        """Return a second thing to start; an executable that is not known stands for none."""
        given = [key for key in ("exec", *INSTEAD) if _is_written(getattr(self, key))]
        if len(given) > 1:
            return Conflict("a node starts one of `exec`, `module` and `script`", tuple(given))
        if self.pkg is not None and "exec" not in given and given:
            return Conflict(f"`pkg` goes with `exec`, not with `{given[0]}`", ("pkg", *given))
        return super().conflict()

    @classmethod
    def required_beside(cls, keys: Collection[str]) -> frozenset[str]:
        """Return the keys that a user must write: `exec` where nothing else is started."""
        required = cls.required_keys()
        return (
            required - {"exec"}
            if any(key in keys and key in cls.model_fields for key in INSTEAD)
            else required
        )

    @classmethod
    def completed(cls, data: Any) -> Any:  # noqa: ANN401 - whatever stands in the file
        """Let a node be without `exec` that starts something else."""
        if isinstance(data, dict) and "exec" not in data and any(data.get(key) for key in INSTEAD):
            return {**data, "exec": None}
        return data


def _is_written(text: Template | None) -> bool:
    return text is not None and not text.faulty

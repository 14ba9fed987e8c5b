"""Components: nodes that a container loads into its own process."""

from __future__ import annotations

from orchestra.description.entity import Conditional
from orchestra.description.fields import Flag, Text
from orchestra.description.model import field
from orchestra.description.parts import Param, Remap


class ComposableNode(Conditional):
    """One component."""

    pkg: Text = field(description="Package of the component.")
    plugin: Text = field(
        description="Its class, as the package registers it; of a component in Python `module:Class` too."
    )
    name: Text | None = field(default=None, description="Name of its node; that of the class where absent.")
    namespace: Text | None = field(
        default=None, description="Namespace; a relative one is put below the pushed one."
    )
    param: tuple[Param, ...] = field(
        default=(), description="Parameters and parameter files, later ones win."
    )
    params_schema: Text | None = field(
        default=None,
        description="What declares its parameters: a JSON Schema file, a definition file of"
        " generate_parameter_library, or a pydantic model (`module:Class`).",
    )
    remap: tuple[Remap, ...] = field(default=(), description="Remappings, the first that matches counts.")
    extra_arg: tuple[Param, ...] = field(
        default=(), description="What else the container is told, as use_intra_process_comms."
    )
    autostart: Flag | None = field(
        default=None, description="Whether a component with a managed life cycle is configured and activated."
    )

"""`set_parameters_from_file`: gives a parameter file to every node."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class SetParametersFromFile(Action):
    """Give a parameter file to every node that follows in this scope, before the node's own parameters."""

    filename: Text = field(description="Path, relative to the launch file.")

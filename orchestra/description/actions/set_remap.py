"""`set_remap`: adds a remapping to every node."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class SetRemap(Action):
    """Add a remapping rule to every node that follows in this scope, before the node's own rules."""

    from_: Text = field(alias="from", description="The name that nodes use.")
    to: Text = field(description="The name that they shall use instead.")

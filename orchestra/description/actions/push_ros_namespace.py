"""`push_ros_namespace`: puts what follows in a namespace."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class PushRosNamespace(Action):
    """Put every node that follows in this scope below a namespace; an absolute one replaces what was pushed."""

    namespace: Text = field(description="The namespace; a relative one is put below the one pushed before.")

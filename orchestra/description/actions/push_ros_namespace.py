"""`push_ros_namespace`: puts what follows in a namespace."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class PushRosNamespace(Action):
    """Put every node that follows in this scope below a namespace; an absolute one replaces what was pushed."""

    namespace: Text = Field(description="The namespace; a relative one is put below the one pushed before.")

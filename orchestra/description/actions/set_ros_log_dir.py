"""`set_ros_log_dir`: where nodes write their own logs."""

from __future__ import annotations

from orchestra.description.entity import Action
from orchestra.description.fields import Text
from orchestra.description.model import field


class SetRosLogDir(Action):
    """Set the folder of the logs that nodes that follow in this scope write themselves."""

    new_log_dir: Text = field(description="Path; a relative one is put below the present folder.")

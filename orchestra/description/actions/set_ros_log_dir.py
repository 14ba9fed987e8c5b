"""`set_ros_log_dir`: where nodes write their own logs."""

from __future__ import annotations

from pydantic import Field

from orchestra.description.entity import Action
from orchestra.description.fields import Text


class SetRosLogDir(Action):
    """Set the folder of the logs that nodes that follow in this scope write themselves."""

    new_log_dir: Text = Field(description="Path; a relative one is put below the present folder.")

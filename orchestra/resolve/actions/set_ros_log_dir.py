"""`set_ros_log_dir`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from orchestra.description.actions.set_ros_log_dir import SetRosLogDir
    from orchestra.resolve.resolution import Resolution

_VARIABLE = "ROS_LOG_DIR"


def visit(action: SetRosLogDir, run: Resolution) -> None:
    """Set the folder of the nodes' own logs: below the present one, which is that of the run where none is set."""
    folder = run.text(action.new_log_dir)
    if isinstance(folder, str):
        joined = os.path.join(_present(run), folder)  # noqa: PTH118 - a text, which may begin with `${run}`
        run.scope.change(_VARIABLE, joined, run.at(action.new_log_dir.span))


def _present(run: Resolution) -> str:
    """Return where nodes write their logs, as rcl finds it (rcl_logging_interface, `get_logging_directory`)."""
    environment = run.scope.environment
    if environment.get(_VARIABLE):
        return environment[_VARIABLE]
    home = environment.get("ROS_HOME")
    return os.path.join(home, "log") if home else run.context.log_folder  # noqa: PTH118 - as above

"""`PythonLaunchDescriptionSource`: a launch file in Python."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.launch_description_source import LaunchDescriptionSource

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in Python, whatever its name."""

    _is_file = True
    _language = "python"

    def __init__(self, launch_file_path: Sub) -> None:
        super().__init__(None, launch_file_path, "interpreted python launch file")

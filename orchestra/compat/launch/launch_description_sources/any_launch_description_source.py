"""`AnyLaunchDescriptionSource`: a launch file of any kind."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.launch_description_source import LaunchDescriptionSource

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file; its name tells the language."""

    _is_file = True

    def __init__(self, launch_file_path: Sub) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")

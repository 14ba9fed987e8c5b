"""`XMLLaunchDescriptionSource`: a launch file in XML."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.launch_description_source import LaunchDescriptionSource

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class XMLLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in XML, whatever its name."""

    _is_file = True
    _language = "xml"

    def __init__(self, launch_file_path: Sub) -> None:
        super().__init__(None, launch_file_path, "interpreted XML launch file")

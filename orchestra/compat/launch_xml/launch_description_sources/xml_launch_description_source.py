"""`XMLLaunchDescriptionSource`: a launch file in XML."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.compat.launch.launch_description_sources.frontend_launch_description_source import (
    FrontendLaunchDescriptionSource,
)

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class XMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    """A launch file in XML, whatever its name."""

    _language = "xml"

    def __init__(self, launch_file_path: Sub) -> None:
        super().__init__(launch_file_path, method="interpreted XML launch file")

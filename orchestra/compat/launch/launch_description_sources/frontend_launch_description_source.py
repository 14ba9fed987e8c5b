"""`FrontendLaunchDescriptionSource`: a launch file in XML or YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from orchestra.compat.launch.launch_description_source import LaunchDescriptionSource

if TYPE_CHECKING:
    from orchestra.compat.text import Sub


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in XML or YAML; its name tells which, and the parser is not looked at, as upstream."""

    _is_file = True

    def __init__(
        self,
        launch_file_path: Sub,
        *,
        method: str = "interpreted frontend launch file",
        parser: Any = None,  # noqa: ARG002 - upstream's signature
    ) -> None:
        super().__init__(None, launch_file_path, method)

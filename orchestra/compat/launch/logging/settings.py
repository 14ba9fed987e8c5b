"""The one `launch_config`."""

from __future__ import annotations

from orchestra.compat.launch.logging.config import LaunchConfig

launch_config = LaunchConfig()

"""What this interpreter's installation offers to nodes."""

from __future__ import annotations

import sys
from pathlib import Path

from orchestra.supervise.environment import Host


def this_host() -> Host:
    """Look at the running interpreter's installation."""
    prefix = Path(sys.prefix)
    return Host(
        prefix=sys.prefix,
        path=str(prefix / "bin") if sys.prefix != sys.base_prefix else None,
        libraries=_wheel_libraries(prefix),
        ament=(prefix / "share" / "ament_index").is_dir(),
    )


def _wheel_libraries(prefix: Path) -> tuple[str, ...]:
    """Return the folders that `ros_wheels_bootstrapper` 0.1 puts on LD_LIBRARY_PATH, in an order that stays."""
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    packages = prefix / "lib" / version / "site-packages"
    if not (packages / "ros_wheels_bootstrapper").is_dir():
        return ()
    folders = sorted(str(folder.resolve()) for folder in packages.glob("ros_*.libs") if folder.is_dir())
    return (str(prefix / "lib"), *folders)

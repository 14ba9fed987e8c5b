"""What this interpreter's installation offers to nodes."""

from __future__ import annotations

import sys
from pathlib import Path

from orchestra.supervise.environment import Host
from orchestra.wheels import library_folders


def this_host() -> Host:
    """Look at the running interpreter's installation."""
    prefix = Path(sys.prefix)
    return Host(
        prefix=sys.prefix,
        path=str(prefix / "bin") if sys.prefix != sys.base_prefix else None,
        libraries=library_folders(prefix),
        ament=(prefix / "share" / "ament_index").is_dir(),
    )

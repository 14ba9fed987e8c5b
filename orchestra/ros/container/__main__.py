"""The process of a container."""

from __future__ import annotations

import sys
from pathlib import Path

# Where this is not installed but run from its sources.
sys.path.append(str(Path(__file__).parents[3]))


def main() -> int:
    """Run the container that the first word names, and return the exit status."""
    from orchestra.ros.container.ending import Ending  # noqa: PLC0415 - before rclpy, whose import takes long

    ending = Ending()
    from orchestra.ros.container.run import run  # noqa: PLC0415 - as above

    return run(sys.argv, ending)


if __name__ == "__main__":
    sys.exit(main())

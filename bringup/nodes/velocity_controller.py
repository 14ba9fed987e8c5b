"""The velocity controller of one robot: drives and stops before obstacles, at 10 Hz of ROS time.

`bringup/params/velocity_controller.yaml` shows its parameters, `bringup/control_node/node.py` its topics and
services.
"""

import os
import signal
import sys


def main() -> None:
    """Run the node until SIGINT or SIGTERM, which both end it with status 0."""
    # From here on, so that not even a signal during the imports leaves a traceback.
    signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))
    # A scan is far too small for a thread pool; numpy reads this once.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # Imported here because numpy must see the line above.
    from bringup.control_node.plain import PlainVelocityController  # noqa: PLC0415
    from bringup.control_node.run import run  # noqa: PLC0415

    sys.exit(run(PlainVelocityController, "velocity_controller"))


if __name__ == "__main__":
    main()

"""The EKF of one robot: fuses its odometry and its IMU into `odometry/filtered` and the transform of its base.

Takes the parameters of robot_localization's `ekf_node`; `bringup/params/ekf.yaml` shows those of the bringup.
"""

import os
import signal
import sys


def main() -> None:
    """Run the node until SIGINT or SIGTERM, which both end it with status 0."""
    # From here on, so that not even a signal during the imports leaves a traceback.
    signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))
    # Matrices of 15x15 gain nothing from threads, and idle ones cost; numpy reads this once.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    # Imported here because numpy must see the lines above.
    from bringup.filter_node.run import run  # noqa: PLC0415

    sys.exit(run())


if __name__ == "__main__":
    main()

"""The velocity controller of one robot as a managed node: it drives while it is active.

The same in everything else as `velocity_controller`, its node's name and its parameters included.
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
    from bringup.control_node.managed import ManagedVelocityController  # noqa: PLC0415
    from bringup.control_node.run import run  # noqa: PLC0415

    sys.exit(run(ManagedVelocityController, "velocity_controller"))


if __name__ == "__main__":
    main()

"""The fleet monitor: sees all robots by their namespaces, tells how they are, and who may drive where.

`bringup/params/fleet_monitor.yaml` shows its parameters, `bringup/fleet_node/node.py` its topics and services.
"""

import signal
import sys


def main() -> None:
    """Run the node until SIGINT or SIGTERM, which both end it with status 0."""
    # From here on, so that not even a signal during the imports leaves a traceback.
    signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))
    # Imported here because that takes a while.
    from bringup.fleet_node.run import run  # noqa: PLC0415

    sys.exit(run())


if __name__ == "__main__":
    main()

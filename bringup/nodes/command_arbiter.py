"""The command arbiter of one robot: lets the most important of its inputs drive, unless a lock holds.

`bringup/params/command_arbiter.yaml` shows its parameters, `bringup/arbiter_node/node.py` its topics.
"""

import signal
import sys


def main() -> None:
    """Run the node until SIGINT or SIGTERM, which both end it with status 0."""
    # From here on, so that not even a signal during the imports leaves a traceback.
    signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))
    # Imported here because that takes a while.
    from bringup.arbiter_node.node import PERIOD, CommandArbiter  # noqa: PLC0415
    from bringup.control_node.run import run  # noqa: PLC0415

    sys.exit(run(CommandArbiter, "command_arbiter", 1.0 / PERIOD))


if __name__ == "__main__":
    main()

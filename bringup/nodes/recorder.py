"""The recorder: writes truth, wheel odometry, filter and contacts of all robots into one file.

`python -m bringup.evaluation draw FOLDER --recording FILE` draws it. Parameters are in `bringup.evaluation.listening`.
"""

import os
import signal
import sys


def main() -> None:
    """Run the node until SIGINT or SIGTERM, which both end it with status 0."""
    # From here on, so that not even a signal during the imports leaves a traceback.
    signal.pthread_sigmask(signal.SIG_BLOCK, (signal.SIGINT, signal.SIGTERM))
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # Imported here because numpy must see the line above.
    from bringup.evaluation.serving import run  # noqa: PLC0415

    sys.exit(run())


if __name__ == "__main__":
    main()

"""The observer process."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

# Where this is not installed but run from its sources.
sys.path.append(str(Path(__file__).parents[3]))


def main() -> int:
    """Observe until standard input ends. The one argument is the pid of the supervisor, with which we die."""
    from orchestra.supervise.keeping import kernel  # noqa: PLC0415 - before rclpy, whose import takes long

    kernel.set_name("orc-observer")
    kernel.die_with_parent(signal.SIGKILL, int(sys.argv[1]))
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # no traceback: whoever signals us wants us gone
    from orchestra.ros.observer.observe import observe  # noqa: PLC0415 - as above

    # Libraries may print: what is meant for the supervisor goes to a descriptor of its own.
    answers = os.dup(1)
    os.dup2(2, 1)
    observe(0, answers)
    return 0


if __name__ == "__main__":
    status = main()
    # Everything is given back; what the interpreter still did would take longer than all the rest of leaving.
    sys.stderr.flush()
    os._exit(status)

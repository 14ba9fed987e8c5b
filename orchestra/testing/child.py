"""`python -m orchestra.testing.child ...`: `orchestra ...` that stops when the test session that started it dies.

A test session that is killed cannot stop what it launched. So the kernel is asked for a SIGTERM at that moment, on
which the keeper stops the run. The request holds over execve(2), and the signal comes when the *thread* that started
us ends (prctl(2), PR_SET_PDEATHSIG).
"""

from __future__ import annotations

import os
import signal
import sys

from orchestra.supervise.keeping import kernel

if __name__ == "__main__":
    kernel.die_with_parent(signal.SIGTERM, int(os.environ.pop("ORCHESTRA_TEST_SESSION")))
    os.execv(sys.executable, [sys.executable, "-m", "orchestra", *sys.argv[1:]])  # noqa: S606 - that is the purpose

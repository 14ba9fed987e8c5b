"""`python -m orchestra.testing.child ...`: `orchestra ...` that stops when the test session that started it dies.

A test session that is killed cannot stop what it launched. So the kernel is asked for a SIGTERM at that moment
(prctl(2), PR_SET_PDEATHSIG; it comes when the *thread* that started us ends), on which the keeper stops the run.
"""

from __future__ import annotations

import os
import signal
import sys

from orchestra.__main__ import main
from orchestra.supervise import kernel

if __name__ == "__main__":
    kernel.die_with_parent(signal.SIGTERM, int(os.environ.pop("ORCHESTRA_TEST_SESSION")))
    sys.exit(main())

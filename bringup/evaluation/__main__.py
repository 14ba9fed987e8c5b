"""`python -m bringup.evaluation`: how good the filters are, in figures and in pictures."""

from __future__ import annotations

import os
import signal
import sys

if __name__ == "__main__":
    # Who reads only the first lines, as head does, is told no error.
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    # Matrices of 15 x 15 gain nothing from threads; numpy reads these once, also in the processes started from here.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    # Imported here because numpy must see the lines above.
    from bringup.evaluation.command import main

    sys.exit(main())

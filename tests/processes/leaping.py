"""The launcher with a wall clock that leaps: each time it is asked it is another hour, day or second.

The clock of a machine cannot be set for one process alone, so the standard library's is replaced before anything of
ours is imported. Time that counts is monotonic and is left as it is.
"""

import itertools
import runpy
import time
from pathlib import Path

_LEAPS = itertools.cycle((0.0, -3600.0, 86400.0, -1e6, 0.5, 1e6))
_real = time.time
time.time = lambda: _real() + next(_LEAPS)

runpy.run_path(str(Path(__file__).with_name("launcher.py")), run_name="__main__")

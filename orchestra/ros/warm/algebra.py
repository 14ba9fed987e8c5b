"""OpenBLAS, which comes with numpy: as it is loaded it starts a thread for each further processor.

These look for work for 2**28 cycles, a tenth of a second, before they sleep: time that whoever makes the plan needs. A
fork ends them, and they begin again in the process that multiplies first (OpenBLAS, driver/others/blas_server.c). All
nodes are forked, so none loses anything by a fork that comes at once.
"""

from __future__ import annotations

import ctypes
import os
from contextlib import suppress
from importlib.util import find_spec

from orchestra.ros.warm.forking import fork

_NAME = "openblas"


def load_algebra() -> None:
    """Load what numpy's wheel has of OpenBLAS, and end its threads; elsewhere numpy loads what there is."""
    libraries = _libraries()
    for library in libraries:
        with suppress(OSError):  # numpy says what is wrong with it
            ctypes.CDLL(library)
    if libraries:
        _end_threads()


def _libraries() -> list[str]:
    """Return the files of it: a wheel has its libraries in a folder beside the package (auditwheel)."""
    spec = find_spec("numpy")
    if spec is None or spec.origin is None:
        return []
    folder = os.path.dirname(os.path.dirname(spec.origin)) + "/numpy.libs"  # noqa: PTH120 - on the way of the first node
    with suppress(OSError):
        return [f"{folder}/{name}" for name in os.listdir(folder) if _NAME in name]  # noqa: PTH208 - as above
    return []


def _end_threads() -> None:
    pid = fork()
    if pid == 0:
        os._exit(0)
    if pid > 0:
        os.waitpid(pid, 0)

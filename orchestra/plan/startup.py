"""The variables that an interpreter, the loader, and what every node imports read before a program begins.

Another value than the fork server's would come too late for a copy of it.
"""

from __future__ import annotations

# PYTHON: the interpreter. LD_, MALLOC_, GLIBC_, LC_: the loader and the C library. RMW_: rcl, when rclpy is imported.
# The rest: numpy's libraries, the tracer, and tools that begin with the interpreter.
_PREFIXES = (
    *("PYTHON", "LD_", "MALLOC_", "GLIBC_", "LC_", "RMW_", "LTTNG_", "ROS_PYTHON_", "ROS_TRACE_"),
    *("OPENBLAS_", "OMP_", "GOTO_", "MKL_", "BLIS_", "NPY_", "NUMPY_", "COVERAGE_", "DEBUGPY_", "PYDEVD_"),
    *("ASAN_", "LSAN_", "TSAN_", "UBSAN_"),
)
# LANG and its like decide the encoding of texts; HOME where packages of the user are.
_NAMES = frozenset({"LANG", "LANGUAGE", "LOCPATH", "GCONV_PATH", "HOME", "_ROS_WHEELS_BOOTSTRAP_COMPLETE"})


def is_read_at_startup(name: str) -> bool:
    """Tell whether a variable has been read when a program begins."""
    return name.startswith(_PREFIXES) or name in _NAMES

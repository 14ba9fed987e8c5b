"""Where files are from: Orchestra, Python, what is installed for it, the kernel, or a project."""

from __future__ import annotations

import os
import sys
import sysconfig
from importlib.util import source_from_cache
from typing import TYPE_CHECKING, Final

from orchestra.witness import looking

if TYPE_CHECKING:
    from collections.abc import Iterable

OURS: Final = os.path.dirname(os.path.dirname(os.path.abspath(__file__))) + os.sep
_PATHS: Final = sysconfig.get_paths()
PYTHON: Final = tuple(
    os.path.join(path, "")
    for name in ("stdlib", "platstdlib")
    for path in {_PATHS[name], os.path.realpath(_PATHS[name])}
)
INSTALLED: Final = tuple(
    os.path.join(path, "")
    for name in ("purelib", "platlib")
    for path in {_PATHS[name], os.path.realpath(_PATHS[name])}
)
OF_THE_KERNEL: Final = ("/proc/", "/sys/", "/dev/")


def is_python(path: str) -> bool:
    """Tell whether a file is part of Python itself, and changes with it alone."""
    return path.startswith(PYTHON) and "/site-packages/" not in path and "/dist-packages/" not in path


def source_of(cached: str) -> str:
    """Return the source of a file with bytecode, that file where there is none."""
    try:
        source = source_from_cache(cached)
    except ValueError:
        return cached
    return source if looking.signature(source) is not None else cached


def of_users(file: str) -> bool:
    """Tell whether code is of neither Orchestra nor Python, nor installed beside them."""
    return not (file.startswith((OURS, "<frozen", *INSTALLED)) or is_python(file))


def own_source(path: object) -> tuple[str, ...]:
    """Return the source of what is opened where that is a file of Orchestra's own."""
    return (source_of(path),) if isinstance(path, str) and path.startswith(OURS) else ()


def loaded(more: Iterable[str] = ()) -> set[str]:
    """Return the files that are loaded as code, and some more; what is part of Python itself is left out."""
    files = {getattr(module, "__file__", None) for module in list(sys.modules.values())}
    return {file for file in (*files, *more) if isinstance(file, str) and not is_python(file)}

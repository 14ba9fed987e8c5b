"""Where files are from: Orchestra, Python, what is installed for it, the kernel, or a project."""

from __future__ import annotations

import os
import sys
import sysconfig
from importlib.util import source_from_cache
from typing import TYPE_CHECKING, Any, Final

from orchestra.witness import looking

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from types import FrameType

OURS: Final = os.path.dirname(os.path.dirname(os.path.abspath(__file__))) + os.sep


def _folders() -> dict[str, str]:
    """Return what `sysconfig.get_paths` tells, which reads how Python was built first: it takes 1 ms."""
    known = {
        "base": sys.prefix,
        "platbase": sys.exec_prefix,
        "installed_base": sys.base_prefix,
        "installed_platbase": sys.base_exec_prefix,
        "platlibdir": sys.platlibdir,
        "py_version_short": f"{sys.version_info.major}.{sys.version_info.minor}",
    }
    try:
        return {
            name: os.path.normpath(sysconfig.get_path(name, expand=False).format(**known))
            for name in ("stdlib", "platstdlib", "purelib", "platlib")
        }
    except KeyError:  # newer ones say more of themselves
        return sysconfig.get_paths()


_PATHS: Final = _folders()
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
_BETWEEN: Final = (os.path.join(OURS, "witness", ""), "<frozen importlib")
_MOST_PATHS: Final = 100_000  # that are remembered


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


def is_asked_for_by_python() -> bool:
    """Tell whether what is being imported is named in a module of Python itself, outside its functions.

    Such modules try others that only some systems have, as `copy` does; whether they are here changes with Python. What
    a function of Python imports may be anything: `importlib.import_module` is one.
    """
    frame: FrameType | None = sys._getframe(1)  # noqa: SLF001 - there is no other way
    while frame is not None and frame.f_code.co_filename.startswith(_BETWEEN):
        frame = frame.f_back
    return frame is not None and frame.f_code.co_name == "<module>" and is_python(frame.f_code.co_filename)


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


class Outside:
    """Tells which paths are of neither Orchestra nor Python.

    `scratch` gives the folder of temporary files, whose names tell nothing; None where there is none.
    """

    def __init__(self, scratch: Callable[[], str | None]) -> None:
        self._scratch = scratch
        self._known: dict[str, str | None] = {}

    def whole(self, path: Any) -> str | None:
        """Return the absolute path of something outside; None for what is no path, or ours alone."""
        if type(path) is str and path in self._known:
            return self._known[path]
        try:
            text = os.fsdecode(path)
        except TypeError:
            return None
        if not text.startswith("/"):
            return self._told(os.path.join(os.getcwd(), text))
        if text not in self._known:
            self._known[text] = self._told(text)
        return self._known[text]

    def shorten(self) -> None:
        """Forget what is known of paths where that is much."""
        if len(self._known) > _MOST_PATHS:
            self._known.clear()

    def _told(self, whole: str) -> str | None:
        scratch = self._scratch()
        if scratch is not None and whole.startswith(scratch):
            return None
        return None if whole.startswith((OURS, "/proc/self/task")) or is_python(whole) else whole

"""Finds our own modules where the interpreter has compiled them before; all else is left to the import system.

That asks each of its finders, lists folders and looks at every file four times over: 130 µs for a module, 40 this way,
and a run imports some four hundred in its processes before the first program is there. What is looked at counts as
there: the bytecode has to be of this interpreter, and of the source as it is now (PEP 3147, PEP 552).
"""

from __future__ import annotations

import marshal
import os
import sys
from _imp import _fix_co_filename  # type: ignore[attr-defined]
from importlib.machinery import ModuleSpec, SourceFileLoader
from importlib.util import MAGIC_NUMBER

TYPE_CHECKING = False  # `typing` itself costs more than this module, which every process imports
if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import CodeType, ModuleType

_OURS = "orchestra."
_TAG = f".{sys.implementation.cache_tag}.pyc"
_BY_TIME = MAGIC_NUMBER + bytes(4)  # what begins a file that is good for one time and size of its source
_HEADER = 16
_MOST = 1 << 16  # bytes; whatever is larger takes the long way


def install() -> None:
    """Let this interpreter find our modules so, where its bytecode is of the common kind and in the common place."""
    ordinary = not sys.flags.optimize and sys.pycache_prefix is None
    if ordinary and not isinstance(sys.meta_path[0], _Compiled):
        sys.meta_path.insert(0, _Compiled())


class _Compiled:
    """A finder, as `sys.meta_path` wants them."""

    def find_spec(
        self, name: str, path: Sequence[str] | None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        """Return how a module of ours is loaded that is compiled; None for all others."""
        del target
        if not name.startswith(_OURS) or path is None or len(path) != 1:
            return None
        stem = f"{path[0]}/{name.rpartition('.')[2]}"
        return _spec(name, f"{stem}.py", None) or _spec(name, f"{stem}/__init__.py", [stem])


class _Loader(SourceFileLoader):
    """One that has the code already; what asks for more gets what it always gets."""

    def __init__(self, name: str, path: str, code: CodeType) -> None:
        super().__init__(name, path)
        self._code: CodeType | None = code

    def get_code(self, fullname: str) -> CodeType | None:
        """Return it the first time, and what is on the disk by then from there on."""
        code, self._code = self._code, None
        return code or super().get_code(fullname)


def _spec(name: str, path: str, inside: list[str] | None) -> ModuleSpec | None:
    folder, _, file = path.rpartition("/")
    cached = f"{folder}/__pycache__/{file[:-3]}{_TAG}"
    code = _compiled(path, cached)
    if code is None:
        return None
    spec = ModuleSpec(name, _Loader(name, path, code), origin=path, is_package=inside is not None)
    spec.submodule_search_locations = inside
    spec.cached = cached
    spec.has_location = True
    return spec


def _compiled(path: str, cached: str) -> CodeType | None:
    """Return the code of a source file from its bytecode; None where that is not there or of another source."""
    try:
        facts = os.stat(path)  # noqa: PTH116 - first: a package has none, and what is opened is taken for ours
        descriptor = os.open(cached, os.O_RDONLY | os.O_CLOEXEC)
    except OSError:
        return None
    try:
        content = os.read(descriptor, _MOST)
    finally:
        os.close(descriptor)
    if (
        content[:_HEADER] != _BY_TIME + _word(int(facts.st_mtime)) + _word(facts.st_size)
        or len(content) == _MOST
    ):
        return None
    try:
        code: CodeType = marshal.loads(memoryview(content)[_HEADER:])  # noqa: S302 - bytecode, as the interpreter does
    except (EOFError, TypeError, ValueError):
        _remove(cached)
        return None
    if code.co_filename != path:
        _fix_co_filename(
            code, path
        )  # it was compiled in another place, or by another name: as the import system does
    return code


def _remove(cached: str) -> None:
    """Remove bytecode that was cut short, as the disk was full when it was written: the import system fails on it."""
    try:
        os.unlink(cached)  # noqa: PTH108 - see above
    except OSError:
        return


def _word(number: int) -> bytes:
    return (number & 0xFFFFFFFF).to_bytes(4, "little")

"""The compiled code of Python launch files, kept for the next plan of a tree, as the interpreter keeps modules.

A plan of the same words is kept as a whole; this is for those after a change of an argument or of a few files, where
to compile takes a quarter of the time. A code counts for the content that it was compiled from, at its path, by this
interpreter. What short looks at it have told is kept with it, and counts as long as they look for the same. All codes
of a tree are in one file, named by the file at its top: fifty files take as long to write as half of the tree takes to
compile. Rejected: `__pycache__` beside launch files, where nobody expects it, and where many may not write.
"""

from __future__ import annotations

import marshal
import os
import sys
import warnings
from contextlib import contextmanager, suppress
from functools import lru_cache
from importlib.util import MAGIC_NUMBER
from typing import TYPE_CHECKING, Any, Final

from orchestra.compat.looks import Compiled
from orchestra.witness.digest import digest_of
from orchestra.witness.looking import read, signature
from orchestra.witness.observing import observer
from orchestra.witness.store import Store

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import CodeType
    from typing import TypeAlias

    _Kept: TypeAlias = tuple[str, bytes, dict[str, bool]]  # digest, code, and what looks have told

_MOST: Final = 32 * 1024 * 1024  # bytes that all trees may take together
_MOST_OF_A_TREE: Final = 8 * 1024 * 1024
_OURS: Final = os.path.dirname(os.path.dirname(os.path.dirname(__file__)))  # noqa: PTH120 - pathlib is slow
_LOOKING: Final = (
    *("compat/looks.py", "compat/signs.py", "compat/idle_names.py", "compat/misused.py"),
    "witness/harmless.py",
)
# Files that are alone of their length so far, by their lines; None where there were several.
_alone: dict[int, Compiled | None] = {}
_MOST_ALONE: Final = 64
_WORTH: Final = 1 << 14  # bytes of source: to compile less takes as long as to write a file


class Codes:
    """The codes of the files that the launch file `top` leads to, kept in a folder; nowhere where it is None.

    What is new is kept when `keep` is called.
    """

    def __init__(self, folder: str | None, top: str) -> None:
        self._store = None if folder is None else Store(folder, _MOST)
        self._key = _key(top)
        with observer().aside():  # they decide nothing: a code is what its source comes to
            self._kept = {} if self._store is None else _unpacked(self._store, self._key)
        self._used: dict[str, _Kept] = {}
        self._new: dict[str, Compiled] = {}
        self._compiled = 0

    def code(self, path: str, source: bytes) -> Compiled:
        """Return the code of a file with this content. Raises what `compile` does."""
        known = self._kept.get(path)
        if known is not None and known[0] == digest_of(source):
            code: CodeType = marshal.loads(known[1])  # noqa: S302 - ours, as what is in `__pycache__`
            self._used[path] = known
            return Compiled(code, source, known[2])
        compiled, lasting = _compiled(path, source)
        if lasting and path not in self._new:
            self._new[path] = compiled
            self._compiled += len(source)
        return compiled

    @property
    def are_to_be_kept(self) -> bool:
        """Whether so much was compiled that it is worth a file."""
        return self._store is not None and self._compiled >= _WORTH

    def keep(self) -> None:
        """Keep what was compiled beside what was kept, if there is a place for it."""
        if self._store is None:
            return
        new = {
            path: (digest_of(made.source), marshal.dumps(made.code), made.told)
            for path, made in self._new.items()
        }
        with observer().aside():
            for codes in (self._kept | new, self._used | new):
                packed = marshal.dumps((self._key, codes))
                if len(packed) <= _MOST_OF_A_TREE:
                    self._store.put(self._key, packed)
                    self._store.prune()
                    break


def _key(top: str) -> str:
    """Return what tells the codes of one tree and interpreter from those of others."""
    ranges = sys._xoptions.get("no_debug_ranges"), os.environ.get("PYTHONNODEBUGRANGES")
    told_by = [signature(f"{_OURS}/{file}") for file in _LOOKING]
    interpreter = sys.version, MAGIC_NUMBER, sys.flags, sys.warnoptions, ranges
    return repr((os.path.abspath(top), *interpreter, told_by))  # noqa: PTH100


def _unpacked(store: Store, key: str) -> dict[str, _Kept]:
    packed = store.content(key)
    if packed is None or len(packed) > _MOST_OF_A_TREE:
        return {}
    try:
        whose, codes = marshal.loads(packed)  # noqa: S302 - as above
    except (EOFError, TypeError, ValueError):
        return {}
    return codes if whose == key and isinstance(codes, dict) else {}


@lru_cache(maxsize=256)
def _compiled(path: str, source: bytes) -> tuple[Compiled, bool]:
    """Return the code of a file, and whether to compile it again would tell nobody anything.

    It is made from that of a file that is written alike where there is one, which has as many lines.
    """
    lines = source.count(b"\n")
    if lines not in _alone:
        code, lasting = _from_compiler(path, source)
        compiled = Compiled(code, source, {})
        if len(_alone) >= _MOST_ALONE:
            del _alone[next(iter(_alone))]
        if lasting:
            _alone[lines] = compiled
        return compiled, lasting
    # Here, because only the second one needs it, and what it imports.
    from orchestra.resolve.python.forms import FORMS  # noqa: PLC0415
    from orchestra.resolve.python.numbered import TOLD  # noqa: PLC0415

    first, _alone[lines] = _alone[lines], None
    if first is not None:
        FORMS.add(first)
        TOLD.add(first)
    alike = FORMS.compiled(path, source)
    if alike is not None:
        return alike, True
    code, lasting = _from_compiler(path, source)
    made = Compiled(code, source, {})
    TOLD.add(made)
    if lasting:
        FORMS.add(made)
    return made, lasting


def _from_compiler(path: str, source: bytes) -> tuple[CodeType, bool]:
    with _told() as told:
        code = compile(source, path, "exec", dont_inherit=True)
    return code, not told


def compile_ahead(path: str) -> None:
    """Compile a file that is asked for soon; where there is anything to tell, whoever asks for it hears that."""
    with suppress(Exception), warnings.catch_warnings():
        warnings.simplefilter("error")
        _compiled(path, read(path))


@contextmanager
def _told() -> Iterator[list[Any]]:
    """Hear of warnings while they are shown as ever, and no filter changes."""
    outer, told = warnings.showwarning, list[Any]()

    def show(message: Warning | str, *args: Any) -> None:
        told.append(message)
        outer(message, *args)

    warnings.showwarning = show  # type: ignore[assignment] # what is told is handed on as it is
    try:
        yield told
    finally:
        warnings.showwarning = outer

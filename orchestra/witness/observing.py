"""Records what this process looks at. A hook of the interpreter stays: only what ends soon is to be watched."""

from __future__ import annotations

import os
import sys
from contextlib import contextmanager
from functools import wraps
from types import CodeType
from typing import TYPE_CHECKING, Any, Final, TypeVar

from orchestra.witness import looking, origins, unknowable
from orchestra.witness.contents import Contents
from orchestra.witness.origins import INSTALLED, is_python, source_of
from orchestra.witness.record import Record, question
from orchestra.witness.variables import ObservedData

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from contextlib import AbstractContextManager

    from orchestra.witness.record import Signature

_AnswerT = TypeVar("_AnswerT")


class Observer:
    """Records what this process looks at. There is one per process, `observer()`.

    `foreign` are modules in other languages, `code` is what is read of ours, `ran_code` tells whether users' has run
    since the record was begun, `ran_freely` whether any but what is `harmless`. Unless it `asks`, no question is
    recorded. No folder is searched for packages that are `ours`.
    """

    def __init__(self) -> None:
        self.record: Record | None = None
        self.scratch: str | None = None
        self.foreign, self.code = set[str](), set[str]()
        self.harmless: CodeType | None = None
        self.paused = self._resting = 0  # how often it is told to record nothing
        self._being_aside = _Aside(self)
        self._seen: dict[str, Signature | None] = {}
        self._parts: set[Record] = set()
        self._contents = Contents()
        self._folders = looking.Folders().listing
        self._installed: Record = Record()
        self.ran_code, self.ran_freely, self.certain = False, False, True
        self._environment: dict[str, str] = {}
        self._paths: set[tuple[Any, ...]] = set()
        self._harmless: set[str] = set()
        self._outside = origins.Outside(lambda: self.scratch)
        self._whole = self._outside.whole
        self.installed, self.asks = False, True
        self.ours: frozenset[str] = frozenset({"orchestra"})
        self.kept: dict[tuple[Any, ...], tuple[Record, Any]] = {}

    @property
    def active(self) -> bool:
        """Whether what happens now is recorded."""
        return self.record is not None and self.paused == 0

    def install(self) -> None:
        """Begin to watch this process, which cannot be undone."""
        if not self.installed:
            self.installed = True
            sys.addaudithook(unknowable.sifted(self._heard, self._harmless))
            looking.wrap(self._wrapped)
            environ: Any = os.environ
            environ._data = ObservedData(environ._data, self)  # noqa: SLF001 - there is no other way to it

    def begin(self, environment: dict[str, str]) -> None:
        """Begin a record; `environment` is the one that counts as being outside."""
        self.record, self._seen, self._parts = Record(), {}, set()
        self.ran_code, self.ran_freely, self.certain = False, False, True
        self._environment, self._paths = environment, set()
        self.paused, self._resting = self.paused - self._resting, 0
        self._contents.forget()
        self._outside.shorten()

    def end(self) -> Record:
        """Return the record, complete with what the files were that have been opened."""
        record = self.record
        if record is None:
            raise AssertionError("nothing has begun")
        self._complete_all(record)
        if self.ran_code:
            record.depend(self._installed)
            if self.foreign:
                record.unknown = record.unknown or f"code outside Python has been loaded: {min(self.foreign)}"
        self.record = None
        return record

    @contextmanager
    def part(self) -> Iterator[Record]:
        """Record for a while what belongs to one part of the result, which may serve others; see `depend`."""
        part, outer, seen, parts = Record(), self.record, self._seen, self._parts
        if outer is None:
            yield part
            return
        self.record, self._seen, self._parts = part, {}, set()
        try:
            yield part
        finally:
            self._complete_all(part)
            self.record, self._seen, self._parts = outer, seen, parts

    def depend(self, part: Record) -> None:
        """Record that the result has a part that is recorded already."""
        if self.record is not None and not self.paused and part not in self._parts:
            self._parts.add(part)
            self.record.depend(part)

    def rest(self) -> None:
        """Record nothing any more, until another record is begun."""
        self.paused, self._resting = self.paused + 1 - self._resting, 1

    def aside(self) -> AbstractContextManager[None]:
        """Record nothing for a while: what is looked at decides nothing, or is recorded in another way."""
        return self._being_aside

    def variable(self, name: str) -> None:
        """Record that a variable of the environment is read."""
        record = self.record
        if record is not None and not self.paused and name not in record.variables:
            record.variables[name] = self._environment.get(name)

    def all_names(self) -> None:
        """Record that the names of all variables are read."""
        if self.active and self.record is not None and not self.record.names:
            self.record.names = looking.names_of(self._environment)

    def file(self, path: str) -> None:
        """Record that a file is read."""
        if self.active and path not in self._seen:
            self._seen[path] = self._contents.opened(path)

    def read(self, path: str, content: bytes) -> None:
        """Take what has just been read from a file, so that it need not be read again to be recorded."""
        if path in self._seen and not self.paused:
            self._contents.read(path, content)

    def answered(self, words: tuple[str, ...], answer: Callable[[], _AnswerT]) -> _AnswerT:
        """Return the answer to a question, and record it instead of what is looked at for it; it is JSON data."""
        if not self.asks:
            return answer()
        with self.aside():
            found = answer()
        if self.active and self.record is not None:
            self.record.answers.setdefault(question(*words), found)
        return found

    def unknown(self, reason: str) -> None:
        """Record that nobody can say what the result depends on."""
        if self.record is not None and not self.paused:
            self.record.unknown, self.certain, self.kept = self.record.unknown or reason, False, {}

    def _look(self, kind: str, path: str) -> None:
        if self.record is not None:
            looks = self.record.looks.setdefault(kind, {})
            if path not in looks:
                with self.aside():
                    looks[path] = self._folders(path) if kind == "listing" else looking.LOOKS[kind](path)

    def _complete_all(self, record: Record) -> None:
        if self._seen:
            with self._being_aside:
                for path, before in self._seen.items():
                    self._contents.complete(record, path, before)

    def _wrapped(self, function: Any, kind: str) -> Any:
        @wraps(function)
        def looked(path: Any, *args: Any, **kwargs: Any) -> Any:
            if self.record is None or self.paused or isinstance(path, int):
                return function(path, *args, **kwargs)
            if kwargs or kind == "access":
                self._looked(kind, path, kwargs)
                return function(path, *args, **kwargs)
            whole, looks = self._whole(path), self.record.looks.setdefault(kind, {})
            if whole is None or whole in looks:
                return function(path, *args)
            try:
                found = function(path)
            except (OSError, ValueError) as error:
                looks[whole] = looking.reason(error)
                raise
            looks[whole] = looking.told(kind, found)
            return found

        return looked

    def _looked(self, kind: str, path: Any, options: dict[str, Any]) -> None:
        if options.get("dir_fd") is not None:
            self.unknown("paths relative to open folders")
            return
        if options.get("follow_symlinks") is False:
            kind = "own_mode"
        whole = self._whole(path)
        if whole is not None:
            self._look(kind, whole)

    def _heard(self, event: str, args: tuple[Any, ...]) -> None:
        """Be told of something by the interpreter that is not known to be harmless."""
        if self.record is None or self.paused:
            return
        try:
            self._note(event, args)
        except Exception as error:  # noqa: BLE001 - it would be raised in whatever is being watched
            self.unknown(f"{event}: {error}")

    def _note(self, event: str, args: tuple[Any, ...]) -> None:
        if event == "open":
            self._opened(*args)
        elif event in ("os.listdir", "os.scandir"):
            self.listed(args[0])
        elif event == "import":
            self._imports(*args[:3])
        elif event == "exec":
            self._executes(args[0])
        elif event in unknowable.CHANGES:
            if any(isinstance(path, str | bytes) and self._whole(path) is not None for path in args[:2]):
                self.unknown(f"{event} changes something")
        elif unknowable.is_unknowable(event):
            self.unknown(event)
        else:
            self._harmless.add(event)

    def _opened(self, path: Any, mode: str | None, flags: int) -> None:
        if isinstance(path, int):
            return
        whole = self._whole(path)
        writes = looking.is_writing(mode, flags)
        if whole is None or whole == os.devnull:
            if not writes:  # as the bytecode of a module, under another name at first
                self.code.update(origins.own_source(path))
            return
        whole = source_of(whole) if whole.endswith(".pyc") else whole
        if writes or whole.startswith(origins.OF_THE_KERNEL):
            self.unknown(f"{whole} is {'written' if writes else 'another one each time'}")
            return
        self.file(whole)
        if whole.startswith(INSTALLED) and whole.endswith(".py"):
            before = looking.signature(whole)
            with self.aside():
                self._contents.complete(self._installed, whole, before)

    def listed(self, path: Any) -> None:
        """Record that it matters what is in a folder."""
        if isinstance(path, int):
            self.unknown("folders that are open")
            return
        whole = self._whole("." if path is None else path)
        if whole is not None:
            self._look("listing", whole)

    def _imports(self, module: str, file: str | None, path: Any) -> None:
        top = module.partition(".")[0]
        if file is not None and not is_python(file):
            self.foreign.add(module)
        if top in self.ours or top in sys.stdlib_module_names or not isinstance(path, list):
            return
        if tuple(path) in self._paths or origins.is_asked_for_by_python():
            return
        self._paths.add(tuple(path))
        for folder in path:
            if isinstance(folder, str) and (whole := self._whole(folder or ".")) is not None:
                self._look("listing", whole)

    def _executes(self, code: Any) -> None:
        if isinstance(code, CodeType) and origins.of_users(code.co_filename) and unknowable.reaches_out(code):
            self.ran_code = True
            self.ran_freely = self.ran_freely or code is not self.harmless
            if code is not self.harmless and (sign := unknowable.sign_in(code)) is not None:
                self.unknown(f"code uses {sign}")


class _Aside:
    """While it is entered, how often that may be, nothing is recorded."""

    __slots__ = ("_observer",)

    def __init__(self, observer: Observer) -> None:
        self._observer = observer

    def __enter__(self) -> None:
        self._observer.paused += 1

    def __exit__(self, *error: object) -> None:
        self._observer.paused -= 1


_OBSERVER: Final = Observer()


def observer() -> Observer:
    """Return what watches this process."""
    return _OBSERVER

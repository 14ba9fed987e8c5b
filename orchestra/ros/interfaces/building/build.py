"""Builds a package of definitions: compiled where there is a compiler, else laid out for the way without one.

What comes of it is a prefix as ament has them: the definitions and the index in `share`, libraries in `lib` and the
Python package. It is made beside its place and moved there as a whole. Of several processes that build the same, one
does and the others wait for it.
"""

from __future__ import annotations

import fcntl
import json
import os
import shutil
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from orchestra.resolve.interfaces import prefixes, sources
from orchestra.resolve.interfaces.available import provided
from orchestra.resolve.packages import ament
from orchestra.ros.interfaces.building import checking
from orchestra.ros.interfaces.building.layout import lay_out

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping

    from orchestra.resolve.interfaces.prefixes import Cache
    from orchestra.resolve.interfaces.sources import Source
    from orchestra.ros.interfaces.reading.mistakes import DefinitionError


class Built(NamedTuple):
    """A package that can be used: its prefix, whether it is compiled and how long that took (None: it was there)."""

    source: Source
    prefix: Path
    compiled: bool
    seconds: float | None


class MistakesError(Exception):
    """The definitions of a package are wrong."""

    def __init__(self, found: list[DefinitionError]) -> None:
        super().__init__("\n".join(map(str, found)))
        self.found = found


class Builder:
    """Builds packages, each with those that it needs, once."""

    def __init__(
        self,
        found: Mapping[str, Source],
        cache: Cache,
        environment: Mapping[str, str],
        tell: Callable[[str], None] = lambda _: None,
    ) -> None:
        self._sources = provided() | dict(found)
        self._cache = cache
        self._installed = ament.prefixes(environment)
        self._built: dict[str, Built] = {}
        self._tell = tell

    def build(self, source: Source) -> Built:
        """Return the package once it can be used.

        Raises:
            MistakesError: a definition is wrong, of the package or of one that it needs.
        """
        if source.name not in self._built:
            self._built[source.name] = self._build(source)
        return self._built[source.name]

    def check(self, source: Source) -> None:
        """Look whether the definitions of a package are right. Raises `MistakesError`."""
        if found := checking.mistakes(source, self._types_of):
            raise MistakesError(found)

    @property
    def built(self) -> tuple[Built, ...]:
        """All that can be used by now, each after those that it needs."""
        return tuple(self._built.values())

    def _build(self, source: Source) -> Built:
        prefix = prefixes.prefix_of(source, self._sources, self._cache)
        if not prefix.is_dir():
            self.check(source)
            needed = {name: self._share(name) for name in sorted(checking.needed(source))}
            with _alone(prefix):
                return self._made(source, prefix, needed)
        for name in sources.mentioned(source):
            if self._installed_share(name) is None and name in self._sources:
                self.build(self._sources[name])
        prefixes.make_latest(source.name, prefix)
        return Built(source, prefix, bool(prefixes.record(prefix)["compiled"]), None)

    def _made(self, source: Source, prefix: Path, needed: Mapping[str, Path]) -> Built:
        """Make a prefix, unless another process just has."""
        if prefix.is_dir():
            return Built(source, prefix, bool(prefixes.record(prefix)["compiled"]), None)
        begin = time.monotonic()
        beside = prefix.with_name(f".{prefix.name}")
        shutil.rmtree(beside, ignore_errors=True)  # of one that was killed
        if self._cache.compiles:
            self._tell(f"{source.name}: {len(source.files)} definitions are compiled, once")
        own = [built.prefix for built in self._built.values() if built.source.name in needed]
        lay_out(source, beside, needed, [Path(sys.prefix), *own], compiles=self._cache.compiles)
        content = {
            "package": source.name,
            "source": str(source.folder.absolute()),
            "compiled": self._cache.compiles,
            "needs": [str(path) for path in own],
        }
        (beside / prefixes.RECORD).write_text(json.dumps(content))
        os.replace(beside, prefix)  # noqa: PTH105 - of a folder
        prefixes.make_latest(source.name, prefix)
        return Built(source, prefix, self._cache.compiles, time.monotonic() - begin)

    def _share(self, name: str) -> Path:
        """Return the share folder of a package that is needed; it is built where it is not installed."""
        installed = self._installed_share(name)
        return installed or self.build(self._sources[name]).prefix / "share" / name

    def _installed_share(self, name: str) -> Path | None:
        found = (prefix / "share" / name for prefix in self._installed if ament.has(prefix, name))
        return next(found, None)

    def _types_of(self, name: str) -> frozenset[str] | None:
        installed = self._installed_share(name)
        if installed is not None:
            return checking.messages_in(installed)
        source = self._sources.get(name)
        return checking.messages_in(source.folder) if source else None


@contextmanager
def _alone(prefix: Path) -> Iterator[None]:
    """Be the only process that builds this prefix."""
    prefix.parent.mkdir(parents=True, exist_ok=True)
    path = prefix.with_name(f".{prefix.name}.lock")
    with path.open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield

"""Where what is built of definitions is kept: a prefix for each package in the user's cache, named by what it is of.

The name holds a digest of the definitions and of all that decides what comes of them: the interpreter, its ROS
packages, whether there is a compiler, and the same of the packages whose types they use. So a prefix that is there is
never out of date, and one that is half built never has the name.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sys
import sysconfig
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.resolve.interfaces.sources import mentioned
from orchestra.witness.place import folder as cache_folder

if TYPE_CHECKING:
    from collections.abc import Mapping

    from orchestra.resolve.interfaces.sources import Source

_LAYOUT: Final = 1  # to be raised when what is put into a prefix changes
_LATEST: Final = "latest"
RECORD: Final = "built.json"
SWITCH: Final = "ORCHESTRA_COMPILE_INTERFACES"


@dataclass(frozen=True, slots=True)
class Cache:
    """Where prefixes are, and what all of them depend on."""

    folder: Path
    host: str
    compiles: bool


def this_cache(environment: Mapping[str, str], *, compiles: bool | None = None) -> Cache | None:
    """Return the user's cache for this interpreter; None where no folder can be told."""
    where = cache_folder(environment)
    if where is None:
        return None
    compiled = has_compiler(environment) if compiles is None else compiles
    return Cache(Path(where, "interfaces"), _host(), compiled)


def has_compiler(environment: Mapping[str, str]) -> bool:
    """Tell whether C and C++ can be compiled here, for this interpreter, and nobody has forbidden it."""
    if environment.get(SWITCH) == "0":
        return False
    programs = ((environment.get("CC") or "gcc", "cc"), (environment.get("CXX") or "g++", "c++"))
    return (
        all(any(map(shutil.which, names)) for names in programs)
        and Path(sysconfig.get_path("include"), "Python.h").is_file()
    )


def prefix_of(source: Source, sources: Mapping[str, Source], cache: Cache) -> Path:
    """Return the prefix of a package, whether or not it is built."""
    return cache.folder / f"{source.name}-{_digest(source, sources, cache, ())}"


def python_folder(prefix: Path) -> Path:
    """Return the folder of a prefix that Python packages are in."""
    version = f"python{sys.version_info.major}.{sys.version_info.minor}"
    return prefix / "lib" / version / "site-packages"


def latest(folder: Path) -> dict[str, Path]:
    """Return the prefix that was built last of each package."""
    try:
        links = sorted((folder / _LATEST).iterdir())
    except OSError:
        return {}
    return {link.name: link.resolve() for link in links if (link / RECORD).is_file()}


def make_latest(name: str, prefix: Path) -> None:
    """Remember a prefix as the one that was built last."""
    links = prefix.parent / _LATEST
    links.mkdir(exist_ok=True)
    beside = links / f".{name}.{os.getpid()}"
    beside.unlink(missing_ok=True)
    beside.symlink_to(Path("..", prefix.name))
    beside.replace(links / name)


def record(prefix: Path) -> dict[str, object]:
    """Return what is written down about a prefix: its source folder, how it was built and what it needs."""
    found: dict[str, object] = json.loads((prefix / RECORD).read_text("utf-8"))
    return found


def _digest(source: Source, sources: Mapping[str, Source], cache: Cache, above: tuple[str, ...]) -> str:
    told = hashlib.sha256(f"{_LAYOUT}\n{cache.host}\n{cache.compiles}\n{source.name}\n".encode())
    for path in source.files:
        content = (source.folder / path).read_bytes()
        told.update(f"{path} {len(content)}\n".encode() + content)
    for name in sorted(mentioned(source)):
        other = sources.get(name)
        if other is not None and name not in above:
            told.update(f"{name} {_digest(other, sources, cache, (*above, source.name))}\n".encode())
    return told.hexdigest()[:20]


def _host() -> str:
    """Return what of this host decides about a build: the interpreter, and the ROS packages that it has."""
    packages = sysconfig.get_path("purelib")
    wheels = [path.name for path in Path(packages).glob("ros_*.dist-info")]
    here = [sys.prefix, sysconfig.get_config_var("SOABI") or "", *sorted(wheels)]
    return hashlib.sha256("\n".join(here).encode()).hexdigest()

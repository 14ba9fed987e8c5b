"""From generated C and C++ to libraries, and the extension through which Python reaches them."""

from __future__ import annotations

import os
import shutil
import subprocess
import sysconfig
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from orchestra.ros.interfaces.building.generating import DISPATCH, FASTRTPS, INTROSPECTION, PYTHON, C

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from orchestra.ros.interfaces.building.generating import Generated

_FLAGS: Final = ("-O1", "-fPIC", "-w", "-DNDEBUG")
_BELOW: Final = ("rosidl_runtime_c", "rcutils")
# What the code of each library calls, besides its own kind of the packages that it depends on.
_NEEDS: Final = {
    C: _BELOW,
    FASTRTPS: (*_BELOW, "rosidl_typesupport_fastrtps_c", "rosidl_typesupport_fastrtps_cpp", "fastcdr"),
    INTROSPECTION: (*_BELOW, "rosidl_typesupport_introspection_c"),
    DISPATCH: (*_BELOW, "rosidl_typesupport_c"),
}
_OWN: Final = {C: (), FASTRTPS: (C,), INTROSPECTION: (C,), DISPATCH: (C,)}


class CompilerError(Exception):
    """The compiler does not take what was generated; `source` is the file, None where it is about no single one."""

    def __init__(self, message: str, source: Path | None) -> None:
        super().__init__(message)
        self.message = message
        self.source = source


class Compiler(NamedTuple):
    """The programs that compile, and the folder of `Python.h`."""

    c: str
    cpp: str
    python: str


class Roots(NamedTuple):
    """A prefix with headers and libraries that the code may use."""

    include: Path
    lib: Path


def find_compiler() -> Compiler | str:
    """Return what compiles here, or why nothing does."""
    c = shutil.which(os.environ.get("CC") or "gcc") or shutil.which("cc")
    cpp = shutil.which(os.environ.get("CXX") or "g++") or shutil.which("c++")
    if c is None or cpp is None:
        return "there is no C and C++ compiler"
    include = sysconfig.get_path("include")
    if not Path(include, "Python.h").is_file():
        return "the headers of Python are not installed"
    return Compiler(c, cpp, include)


class Job(NamedTuple):
    """What is compiled: the package, what was generated, where the results go and what else is there."""

    package: str
    generated: Generated
    lib: Path
    objects: Path
    roots: Sequence[Roots]
    dependencies: Sequence[str]


def compile_all(job: Job, compiler: Compiler) -> None:
    """Compile and link everything. Raises `CompilerError`."""
    job.lib.mkdir(parents=True, exist_ok=True)
    flags = [*_FLAGS, *_includes(job, compiler)]
    sources = {name: _sources(folder) for name, folder in job.generated.folders.items()}
    sources[PYTHON] = sorted(job.generated.python.rglob("*.c"))
    todo = [(name, source) for name, files in sources.items() for source in files]
    # The C++ first: it takes longest, and everything else fits beside it.
    todo.sort(key=lambda item: item[1].suffix != ".cpp")
    with ThreadPoolExecutor(max(os.cpu_count() or 1, 1)) as pool:
        made = list(pool.map(lambda item: _compiled(item[1], _object(job, *item), compiler, flags), todo))
    objects = {
        name: [path for (kind, _), path in zip(todo, made, strict=True) if kind == name] for name in sources
    }
    for name in (C, FASTRTPS, INTROSPECTION, DISPATCH):
        _link(job, compiler, objects[name], job.lib / _library(job.package, name), _names(job, name))
    _link_extension(job, compiler, objects[PYTHON])


def _sources(folder: Path) -> list[Path]:
    return sorted([*folder.rglob("*.c"), *folder.rglob("*.cpp")])


def _object(job: Job, name: str, source: Path) -> Path:
    return job.objects / name / f"{source.parent.parent.name}_{source.parent.name}_{source.name}.o"


def _includes(job: Job, compiler: Compiler) -> list[str]:
    import numpy as np  # noqa: PLC0415 - only who compiles needs its headers

    own = [folder for name, folder in job.generated.folders.items() if name != PYTHON]
    roots = [root.include for root in job.roots if root.include.is_dir()]
    packages = [path for root in roots for path in sorted(root.iterdir()) if path.is_dir()]
    folders = [*own, *roots, *packages, Path(compiler.python), Path(np.get_include())]
    return [word for folder in folders for word in ("-I", str(folder))]


def _compiled(source: Path, target: Path, compiler: Compiler, flags: Sequence[str]) -> Path:
    target.parent.mkdir(parents=True, exist_ok=True)
    is_cpp = source.suffix == ".cpp"
    program, standard = (compiler.cpp, "-std=c++17") if is_cpp else (compiler.c, "-std=gnu11")
    _call([program, standard, *flags, "-c", str(source), "-o", str(target)], source)
    return target


def _call(command: Sequence[str], source: Path | None) -> None:
    done = subprocess.run(command, capture_output=True, text=True, check=False, errors="replace")  # noqa: S603 - the user's compiler
    if done.returncode != 0:
        told = [
            line for line in done.stderr.splitlines() if "error" in line.lower()
        ] or done.stderr.splitlines()
        raise CompilerError(told[0] if told else f"{command[0]} ended with {done.returncode}", source)


def _library(package: str, name: str) -> str:
    return f"lib{package}__{name}.so"


def _names(job: Job, name: str) -> list[str]:
    """Return the libraries that a library of the package needs, without what is around the names."""
    own = [f"{job.package}__{other}" for other in _OWN[name]]
    others = [f"{package}__{kind}" for package in job.dependencies for kind in {name, C}]
    return [*own, *others, *_NEEDS[name]]


def _link(job: Job, compiler: Compiler, objects: Iterable[Path], target: Path, needed: Sequence[str]) -> None:
    here = [f"-l:{_found(job, name)}" for name in needed if _found(job, name)]
    folders = [f"-L{folder}" for folder in (job.lib, *(root.lib for root in job.roots))]
    paths = [f"-Wl,-rpath,{folder}" for folder in ("$ORIGIN", *(root.lib for root in job.roots))]
    keep = ["-Wl,--no-as-needed", f"-Wl,-soname,{target.name}"]
    _call(
        [compiler.cpp, "-shared", *map(str, objects), *keep, *folders, *here, *paths, "-o", str(target)], None
    )


def _found(job: Job, name: str) -> str | None:
    """Return the file of a library, None where there is none: not every package has every kind."""
    file = f"lib{name}.so"
    return (
        file
        if any((folder / file).is_file() for folder in (job.lib, *(root.lib for root in job.roots)))
        else None
    )


def _link_extension(job: Job, compiler: Compiler, objects: Sequence[Path]) -> None:
    """Link the extension: it needs all kinds, which the middleware looks for by their names when it is loaded."""
    module = f"{job.package}_s__{DISPATCH}{sysconfig.get_config_var('EXT_SUFFIX')}"
    own = [f"{job.package}__{name}" for name in (DISPATCH, FASTRTPS, INTROSPECTION, C)]
    # The functions that convert messages of the packages it depends on are in a library of each.
    converters = [f"{package}__{PYTHON}" for package in job.dependencies]
    converter = job.lib / _library(job.package, PYTHON)
    entry = [path for path in objects if ".ep." in path.name]
    _link(
        job,
        compiler,
        [path for path in objects if path not in entry],
        converter,
        [*own, *converters, *_BELOW],
    )
    names = [f"{job.package}__{PYTHON}", *own, *_BELOW]
    above = os.path.relpath(job.lib, job.generated.python)
    target = job.generated.python / module
    placed = job._replace(lib=job.lib)
    _link_at(placed, compiler, entry, target, names, f"$ORIGIN/{above}")


def _link_at(
    job: Job, compiler: Compiler, objects: Sequence[Path], target: Path, needed: Sequence[str], origin: str
) -> None:
    here = [f"-l:{_found(job, name)}" for name in needed if _found(job, name)]
    folders = [f"-L{folder}" for folder in (job.lib, *(root.lib for root in job.roots))]
    paths = [f"-Wl,-rpath,{folder}" for folder in (origin, *(root.lib for root in job.roots))]
    _call(
        [
            compiler.cpp,
            "-shared",
            *map(str, objects),
            "-Wl,--no-as-needed",
            *folders,
            *here,
            *paths,
            "-o",
            str(target),
        ],
        None,
    )

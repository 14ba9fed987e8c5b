"""What is in the prefix of a package that is built."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.resolve.interfaces.prefixes import python_folder
from orchestra.ros.interfaces.building import compiling, generating
from orchestra.ros.interfaces.building.checking import shown
from orchestra.ros.interfaces.reading.mistakes import DefinitionError
from orchestra.ros.interfaces.serving import module_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from orchestra.resolve.interfaces.sources import Source

_INDEX: Final = Path("share", "ament_index", "resource_index")
_WITHOUT_COMPILER: Final = '''\
"""The types of {package}, made of their definitions when they are asked for."""

from pathlib import Path

from orchestra.ros.interfaces.definitions import take_over

take_over(__name__, Path(__file__).parents[4] / "share" / __name__)
'''


def lay_out(
    source: Source, prefix: Path, needed: Mapping[str, Path], roots: Sequence[Path], *, compiles: bool
) -> None:
    """Fill a prefix; `needed` has the share folders of the packages whose types are used, `roots` their prefixes.

    Raises:
        DefinitionError: the compiler refuses what comes of a definition.
    """
    share = prefix / "share" / source.name
    for path in source.files:
        target = share / path
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source.folder / path, target)
    _index(source, prefix)
    python = python_folder(prefix)
    if compiles:
        _compiled(source, prefix, needed, roots)
    else:
        (python / source.name).mkdir(parents=True)
        (python / source.name / "__init__.py").write_text(_WITHOUT_COMPILER.format(package=source.name))


def _index(source: Source, prefix: Path) -> None:
    for resource in ("packages", "rosidl_interfaces"):
        (prefix / _INDEX / resource).mkdir(parents=True)
    (prefix / _INDEX / "packages" / source.name).write_text("")
    lines = "".join(f"{path.as_posix()}\n" for path in source.files)
    (prefix / _INDEX / "rosidl_interfaces" / source.name).write_text(lines)
    share = prefix / "share" / source.name
    manifest = source.folder / "package.xml"
    if manifest.is_file():
        shutil.copyfile(manifest, share / "package.xml")


def _compiled(source: Source, prefix: Path, needed: Mapping[str, Path], roots: Sequence[Path]) -> None:
    work = prefix / "work"
    work.mkdir()
    share = prefix / "share" / source.name
    task = generating.Work(source.name, source.files, share, work, roots[0], needed)
    compiler = compiling.find_compiler()
    if isinstance(compiler, str):
        raise DefinitionError(f"it cannot be compiled: {compiler}", shown(source.folder))
    try:
        generated = generating.generate(task, python_folder(prefix))
    except generating.GeneratorError as error:
        raise DefinitionError(f"the generators of rosidl refuse it: {error}", shown(source.folder)) from error
    where = [compiling.Roots(root / "include", root / "lib") for root in roots]
    job = compiling.Job(source.name, generated, prefix / "lib", work / "objects", where, sorted(needed))
    try:
        compiling.compile_all(job, compiler)
    except compiling.CompilerError as error:
        file = _definition_of(source, error.source)
        raise DefinitionError(f"the compiler refuses it: {error.message}", shown(file)) from error
    _keep_headers(source.name, generated, prefix / "include" / source.name)
    for path in generated.python.rglob("*.c"):
        path.unlink()
    shutil.rmtree(work)


def _keep_headers(package: str, generated: generating.Generated, target: Path) -> None:
    """Keep the headers that packages need which use the types."""
    for folder in generated.folders.values():
        for header in folder.rglob("*.h"):
            place = target / header.relative_to(folder)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(header, place)
    (target / package).mkdir(parents=True, exist_ok=True)


def _definition_of(source: Source, generated: Path | None) -> Path:
    """Return the definition that a generated file comes from, the package's folder where it is about no single one."""
    if generated is None:
        return source.folder
    name = f"_{generated.name.lstrip('_')}"
    kinds = set(generated.parts)
    for path in source.files:
        stem = module_of(path.stem)
        if path.parts[0] in kinds and name.startswith((f"{stem}__", f"{stem}_s.", f"{stem}.")):
            return source.folder / path
    return source.folder

"""From definitions to C and Python, by the generators of rosidl, each in a process of its own.

Reading and filling in templates is all that they do, for seconds, so as many run at once as there are processors.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

C: Final = "rosidl_generator_c"
FASTRTPS: Final = "rosidl_typesupport_fastrtps_c"
INTROSPECTION: Final = "rosidl_typesupport_introspection_c"
DISPATCH: Final = "rosidl_typesupport_c"
PYTHON: Final = "rosidl_generator_py"
_DESCRIPTIONS: Final = "rosidl_generator_type_description"
_WITH_VISIBILITY: Final = (C, FASTRTPS, INTROSPECTION)
_PROGRAM: Final = Path(__file__).with_name("generator.py")


class GeneratorError(Exception):
    """A generator of rosidl refuses the definitions."""


class Generated(NamedTuple):
    """Where the generators have written: a folder of each, and the folder of the Python package."""

    folders: dict[str, Path]
    python: Path


class Work(NamedTuple):
    """What is generated: the package, its definitions relative to `share`, their folder, and where to write.

    `installed` is where the generators have their templates; `shares` the share folders of the packages whose types
    the definitions name.
    """

    package: str
    files: Sequence[Path]
    share: Path
    target: Path
    installed: Path
    shares: Mapping[str, Path]


def generate(work: Work, python: Path) -> Generated:
    """Generate everything; `python` is the folder that the Python package comes into. Raises `GeneratorError`."""
    translated = {
        "share": str(work.share),
        "translated": [str(file) for file in work.files if file.suffix != ".idl"],
    }
    paths = [f"{package}:{share}" for package, share in work.shares.items()]
    _run(work, _DESCRIPTIONS, work.share, {"include_paths": paths, **translated})
    folders = {name: work.target / name for name in (C, FASTRTPS, INTROSPECTION, DISPATCH)}
    for name in _WITH_VISIBILITY:
        _visibility(work, name, folders[name] / work.package)
    targets = {name: folder / work.package for name, folder in folders.items()}
    targets[PYTHON] = python / work.package
    with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        # Those that take longest first.
        names = (PYTHON, C, FASTRTPS, INTROSPECTION, DISPATCH)
        list(pool.map(lambda name: _run(work, name, targets[name], _sources(work, name)), names))
    (python / work.package / "__init__.py").write_text("")
    return Generated(folders, python / work.package)


def _idl(work: Work) -> list[str]:
    return [file.with_suffix(".idl").as_posix() for file in work.files]


def _sources(work: Work, name: str) -> dict[str, Any]:
    """Return what the generator of C is told besides: the definitions as they were written, and their hashes."""
    if name != C:
        return {}
    return {
        "type_description_tuples": [
            f"{file}:{work.share / Path(file).with_suffix('.json')}" for file in _idl(work)
        ],
        "ros_interface_files": [str(work.share / file) for file in work.files],
    }


def _run(work: Work, name: str, target: Path, arguments: Mapping[str, Any]) -> None:
    """Have a generator do something."""
    target.mkdir(parents=True, exist_ok=True)
    content = {
        "package_name": work.package,
        "output_dir": str(target),
        "template_dir": str(_resources(work, name)),
        "target_dependencies": [],
        "idl_tuples": [f"{work.share}:{file}" for file in _idl(work)],
        **arguments,
    }
    task = work.target / f"{name}.json"
    task.write_text(json.dumps(content))
    command = [sys.executable, "-P", "-W", "ignore", str(_PROGRAM), name, str(task)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, errors="replace")  # noqa: S603 - a program of ours
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        raise GeneratorError(lines[-1] if lines else f"{name} ended with {done.returncode}")


def _resources(work: Work, name: str) -> Path:
    return work.installed / "share" / name / "resource"


def _visibility(work: Work, name: str, target: Path) -> None:
    """Write the header that tells which symbols a library shows."""
    file = f"{name}__visibility_control.h"
    text = (_resources(work, name) / f"{file}.in").read_text()
    text = text.replace("@PROJECT_NAME_UPPER@", work.package.upper()).replace("@PROJECT_NAME@", work.package)
    (target / "msg").mkdir(parents=True, exist_ok=True)
    (target / "msg" / file).write_text(text)

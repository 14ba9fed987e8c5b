"""Paths in descriptions: relative to the launch file first, then to the working directory."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import HERE, Code, Severity
from orchestra.location import displayed, is_file, is_python
from orchestra.resolve.near_paths import exists, near_names, near_path, related_names, rewritten
from orchestra.resolve.refusals import made_at, refuse_value

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.description.text import Template
    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution


def folder_of(file: str | None) -> Path:
    """Return the folder that relative paths of a launch file begin in."""
    return Path(file).parent if file else Path.cwd()


def existing_file(value: Value, written: Template, what: str, run: Resolution) -> str | None:
    """Return the absolute path of a file, None where there is none (which has been reported).

    `written` is the text that the value is from.
    """
    if value.text.startswith("~/"):
        # Here, because hardly any path does.
        from orchestra.resolve.path_forms import warn_of_home  # noqa: PLC0415

        warn_of_home(value, written.raw, run)
        return _found(_start_of(run.context.file), value.text)
    return file_below(_start_of(run.context.file), value, what, run, written.raw)


def beside(file: str | None, written: str) -> str | None:
    """Return the absolute path of a file that a launch file names, None where there is none."""
    return _found(_start_of(file), written)


def check_folder(value: Value, written: Template, run: Resolution) -> None:
    """Report a working directory that is not there, where it should be: beside the launch file or in a package."""
    folder, path = folder_of(run.context.file), _expanded(value.text)
    prefixes = run.scope.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    settled = (folder, *(Path(prefix) for prefix in prefixes if prefix))
    if not value.text or "${" in value.text or run.later or exists(Path.cwd() / path):
        return
    if path.is_absolute() and not any(map(path.is_relative_to, settled)):
        return  # of the machine that it runs on
    whole = Path.cwd() / path
    near = near_path(whole, written.raw)
    message = f"there is no folder {displayed(str(whole))}: the process cannot be started in it"
    run.problems.warning(Code.MISSING_FILE, message, value.location, suggestion=near)


def may_come(value: Value, run: Resolution) -> bool:
    """Return whether a file that is not there may be written later: none of a package, none beside the launch file."""
    folder, path = folder_of(run.context.file), _expanded(value.text)
    prefixes = run.scope.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    settled = (folder, *(Path(prefix) for prefix in prefixes if prefix))
    return (
        path.is_absolute()
        and _found(str(folder), value.text) is None
        and not any(map(path.is_relative_to, settled))
    )


def settled_path(value: Value, run: Resolution) -> Path | None:
    """Return the path of a file that is not there and should be: beside the launch file, or in a package."""
    if _is_there(value.text, run):
        return None
    folder, written = folder_of(run.context.file), _expanded(value.text)
    prefixes = run.scope.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    settled = (folder, *(Path(prefix) for prefix in prefixes if prefix))
    path = Path(os.path.normpath(folder / written))
    known = any(map(path.is_relative_to, settled))
    return path if known and not exists(path) and _found(str(folder), value.text) is None else None


def _is_there(written: str, run: Resolution) -> bool:
    """Return whether a file is there as far as no path has to be put together, which is slow, to find that out."""
    folder = _start_of(run.context.file)
    if written.startswith("/"):
        prefixes = (folder, *run.scope.environment.get("AMENT_PREFIX_PATH", "").split(os.pathsep))
        plain = any(prefix and written.startswith(f"{prefix}/") for prefix in prefixes)
    else:
        plain = not written.startswith("~")
    return plain and ".." not in written and _found(folder, written) is not None


def file_below(
    folder: str, value: Value, what: str, run: Resolution, written: str | None = None
) -> str | None:
    """Return the absolute path of a file given relative to a folder, or to the working directory.

    None where there is none, which has been reported; a file of the machine may be on another one.
    """
    found = _found(folder, value.text)
    if found is None:
        path = Path(folder) / _expanded(value.text)
        folder_there = exists(path)
        message = f"there is no {what} {displayed(str(path))}" + (": it is a folder" if folder_there else "")
        changes = () if folder_there else near_names(path) or related_names(path)
        if _may_be_elsewhere(value, folder_there=folder_there, changes=changes, run=run):
            told = f"{message} {HERE}: what it would give is left open"
            run.problems.weighed(run.inputs.weights.variable, Code.MISSING_FILE, told, value.location)
            return None
        _refuse_path(value, value.text if written is None else written, changes, message, run)
    return found


def _may_be_elsewhere(
    value: Value, *, folder_there: bool, changes: Sequence[tuple[str, str]], run: Resolution
) -> bool:
    """Return whether another machine may have a file, which is only looked for in a check."""
    if folder_there or run.inputs.weights.variable is Severity.ERROR:
        return False
    # Here, because most files that are named are there.
    from orchestra.resolve.lacking import is_certain, is_of_the_machine  # noqa: PLC0415

    path, file = str(_expanded(value.text)), run.context.file or ""
    return not is_certain(changes) and is_of_the_machine(path, file, run.scope.environment)


def _refuse_path(
    value: Value, written: str, changes: Sequence[tuple[str, str]], message: str, run: Resolution
) -> None:
    """Report a path that is none where its wrong part stands; where that is not known, where the path is used."""
    # Here, because most files that are named are there.
    from orchestra.resolve.misspelt import misspelt  # noqa: PLC0415
    from orchestra.resolve.other_packages import of_other_package  # noqa: PLC0415
    from orchestra.resolve.path_forms import form_meant, of_share  # noqa: PLC0415
    from orchestra.resolve.python_forms import without_python  # noqa: PLC0415

    form = None if is_python(value.location) else form_meant(written)
    if form is not None:
        run.problems.error(Code.MISSING_FILE, f"{message}: {form[0]}", value.location, suggestion=form[1])
        return
    place = None if is_python(value.location) else misspelt(value, written, changes)
    if place is not None:
        used = () if place.at == value.location else (f"it is used at {value.location}",)
        run.problems.error(Code.MISSING_FILE, message, place.at, suggestion=place.instead, notes=used)
        return
    near = rewritten(written, changes) if changes else without_python(written)
    near = near or of_share(value.text, written) or of_other_package(value.text, written, run)
    if near is not None and near == written:  # the wrong part of it came from elsewhere
        refuse_value(value, run.problems, Code.MISSING_FILE, message, meant=rewritten(value.text, changes))
        return
    # Where one variable is all of the path, the file is named where that is set.
    origin = made_at(value) if near is None and not is_python(value.location) else None
    if origin is None or is_python(origin):
        run.problems.error(Code.MISSING_FILE, message, value.location, suggestion=near)
    else:
        used = (f"it is used at {value.location}",)
        run.problems.error(Code.MISSING_FILE, message, origin, notes=used)


def _start_of(file: str | None) -> str:
    return os.path.dirname(file) if file else os.getcwd()  # noqa: PTH109, PTH120 - pathlib is slow


def _found(folder: str, written: str) -> str | None:
    """Return the absolute path of a file that is there, relative to a folder or else to the working directory."""
    # pathlib, which is slow, only for what it reads otherwise than the system: somebody's home, a slash at the end.
    plain = not written.startswith("~") and not written.endswith(("/", "/."))
    path = written if plain else str(_expanded(written))
    for candidate in (os.path.join(folder, path), os.path.join(os.getcwd(), path)):  # noqa: PTH109, PTH118
        if is_file(candidate):
            return os.path.normpath(candidate)
    return None


def _expanded(written: str) -> Path:
    try:
        return Path(written).expanduser()
    except RuntimeError:  # `~somebody` where there is no somebody
        return Path(written)

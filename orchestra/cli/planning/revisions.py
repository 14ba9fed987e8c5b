"""Launch files as they were in a git revision, with all that they include from the same repository.

The whole revision is written to a temporary folder through an index of its own: unlike a worktree, that leaves nothing
in the repository, and unlike an archive it leaves no file out.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import tempfile
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.cli.planning import sources
from orchestra.dataclass import dataclass
from orchestra.errors import DescriptionError, RunError, UsageError
from orchestra.fields import replace
from orchestra.location import is_file
from orchestra.plan.portable import redigested
from orchestra.plan.relocated import rewritten
from orchestra.resolve.packages import InstalledPackages

if TYPE_CHECKING:
    from argparse import Namespace
    from collections.abc import Iterator, Sequence

    from orchestra.cli.planning.sources import Made

# To write a repository of a gigabyte takes some seconds.
_PATIENCE = 120.0


@dataclass(frozen=True, slots=True)
class Revision:
    """A file in a revision: the repository's folder, the revision as it was written, the path below the folder."""

    root: Path
    name: str
    path: str


def find(word: str, file: str | None) -> Revision | None:
    """Return what `REV` or `REV:PATH` means beside a launch file, None where it is no revision."""
    beside = Path(file).resolve().parent if file is not None else Path.cwd()
    root = _git(beside, "rev-parse", "--show-toplevel")
    if root is None:
        return None
    name, colon, path = word.partition(":")
    if (
        not name
        or name.startswith("-")
        or _git(beside, "rev-parse", "--verify", "--quiet", f"{name}^{{commit}}") is None
    ):
        return None
    folder = Path(root).resolve()
    if colon:
        return Revision(folder, name, path)
    if file is None:
        raise UsageError(f"'{word}' names no file: write {name}:PATH")
    return Revision(folder, name, os.path.relpath(Path(file).resolve(), folder))


def why_none(file: str | None) -> str:
    """Return what to say where no revision can be found beside a launch file, nothing where it is the name of it."""
    beside = Path(file).resolve().parent if file is not None else Path.cwd()
    root = _git(beside, "rev-parse", "--show-toplevel")
    return f" of {root}" if root is not None else f": {beside} is in no git repository"


def made(revision: Revision, words: Sequence[str], options: Namespace) -> Made:
    """Make the plan of a file in its revision, with these arguments.

    Places and paths in it are those of the working tree. Raises `UsageError` where the revision has no such file, or
    errors in it.
    """
    label = f"{revision.name}:{revision.path}"
    with _written(revision) as copy:
        path = str(copy / revision.path)
        if not is_file(path):
            raise UsageError(f"there is no {revision.path} in {revision.name}")
        with _inside(copy, revision.root):
            packages = _Packages(os.environ, revision.root, copy)
            try:
                found = sources.from_file(path, words, options, packages)
            except DescriptionError as error:
                raise UsageError(_told(error, label)) from None
    plan = rewritten(found.plan, lambda text: text.replace(str(copy), str(revision.root)))
    return replace(found, plan=redigested(plan), label=" ".join([label, *words]))


def _told(error: DescriptionError, label: str) -> str:
    first = next((problem for problem in error.problems if problem.severity == "error"), error.problems[0])
    place = f" at {first.span}" if first.span is not None else ""
    return f"{label} has errors: {first.message}{place}"


@contextmanager
def _inside(copy: Path, root: Path) -> Iterator[None]:
    """Go where in the copy the working directory would be, so that relative paths are those of the revision."""
    here = Path.cwd().resolve()
    if not here.is_relative_to(root):
        yield
        return
    there = copy / here.relative_to(root)
    there.mkdir(parents=True, exist_ok=True)
    with contextlib.chdir(there):
        yield


@contextmanager
def _written(revision: Revision) -> Iterator[Path]:
    """Write all files of a revision to a folder that goes away afterwards. Raises `RunError`."""
    with tempfile.TemporaryDirectory(prefix="orchestra-revision-") as made_here:
        folder = Path(made_here).resolve()
        index, copy = folder / "index", folder / "tree"
        copy.mkdir()
        environment = {**os.environ, "GIT_INDEX_FILE": str(index)}
        for words in (
            ("read-tree", f"{revision.name}^{{tree}}"),
            ("checkout-index", "--all", "--quiet", f"--prefix={copy}{os.sep}"),
        ):
            if _git(revision.root, *words, environment=environment) is None:
                raise RunError(f"git could not write the files of {revision.name}")
        yield copy


def _git(folder: Path, *words: str, environment: dict[str, str] | None = None) -> str | None:
    """Return what git prints, None where it fails or is not installed."""
    try:
        done = subprocess.run(  # noqa: S603 - nothing here is a shell
            ["git", "-C", str(folder), *words],  # noqa: S607 - git is where PATH says
            env=environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            timeout=_PATIENCE,
            check=False,
        )
    except (FileNotFoundError, subprocess.TimeoutExpired):
        return None
    return os.fsdecode(done.stdout).strip() if done.returncode == 0 else None


class _Packages(InstalledPackages):
    """Packages of which those that lie in the repository are taken from the copy."""

    def __init__(self, environment: os._Environ[str], root: Path, copy: Path) -> None:
        super().__init__(environment)
        self._root = root
        self._copy = copy

    def prefix(self, package: str) -> str | None:
        return self._moved(super().prefix(package))

    def share(self, package: str) -> str | None:
        return self._moved(super().share(package))

    def _moved(self, path: str | None) -> str | None:
        if path is None or not Path(path).resolve().is_relative_to(self._root):
            return path
        moved = self._copy / Path(path).resolve().relative_to(self._root)
        return str(moved) if moved.is_dir() else path

"""Launch files as people name them.

PATH            a file
PACKAGE FILE    a file of that name anywhere in the share folder of a package, as `ros2 launch`
PACKAGE NAME    the one launch file of the package with that short name: `bringup` for `bringup_launch.py`
PACKAGE/NAME    the same in one word
"""

from __future__ import annotations

import os
import re
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.errors import UsageError
from orchestra.location import is_file
from orchestra.nearest import nearest
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from orchestra.resolve.context import Packages

_NAMED = pattern(r".(\.launch|[._-]launch\.(py|xml|ya?ml))$")
_KEY = pattern(r"""^(\{\s*)?["']?launch["']?\s*:""", re.MULTILINE)
_FUNCTION = "generate_launch_description"
_MARKS = {
    ".py": pattern(rf"^\s*(async\s+)?def\s+{_FUNCTION}\b", re.MULTILINE),
    ".xml": pattern(r"<launch[\s>]"),
    ".yaml": _KEY,
    ".yml": _KEY,
}
TEXTS = frozenset(_MARKS)  # the endings behind which the text tells what a file is
_LONGEST_SEARCH = 1 << 16  # bytes: what marks a launch file does not stand behind pages of data


def find_launch_file(words: Sequence[str], packages: Packages) -> tuple[str, tuple[str, ...]]:
    """Return the absolute path of the launch file that the first words name, and the words after it.

    A first word that is a file is a path, whatever else it may be. Raises `UsageError` where there is no such file,
    or more than one.
    """
    first, rest = words[0], tuple(words[1:])
    if ":=" in first:
        raise UsageError(f"the launch file comes before its arguments, '{first}' is one")
    if is_file(first):
        return os.path.normpath(Path.cwd() / first), rest
    package, _, name = first.partition("/")
    share = packages.share(package)
    if share is not None and name:
        return _short(Path(share), package, name, first), rest
    if not name and rest and ":=" not in rest[0] and not _is_file_name(first):
        return _in_share(_share(package, packages), package, rest[0]), rest[1:]
    if share is not None and not name:
        raise UsageError(f"which launch file of the package '{package}'? {_listed(Path(share))}")
    raise not_there(first)


def launch_files(folder: Path) -> Iterator[Path]:
    """Yield the launch files below a folder, sorted by path, hidden folders left out."""
    yield from (path for path in sorted(files_below(folder)) if is_launch_file(path))


def files_below(folder: str | Path) -> Iterator[Path]:
    """Yield the files below a folder, hidden folders and links to folders left out, as upstream leaves these."""
    for here, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        yield from (Path(here, name) for name in files)


def is_launch_file(path: Path) -> bool:
    """Tell whether a file is plainly a launch file: by its name, else by what its text holds."""
    return is_launch_name(path.name) or (
        path.suffix in _MARKS and is_launch_text(path.name, _beginning(path))
    )


def is_launch_name(name: str) -> bool:
    """Tell whether a file name says that it is a launch file: `a.launch`, `a.launch.py`, `a_launch.py`."""
    return _NAMED.search(name) is not None


def is_launch_text(name: str, text: str) -> bool:
    """Tell whether the text of a file of this name begins as that of a launch file.

    It is searched, so that a syntax error hides nothing; Python is parsed as well, because a program that writes launch
    files, a test for one, holds the text of such a function, and is none itself.
    """
    ending = Path(name).suffix
    mark = _MARKS.get(ending)
    if mark is None or mark.search(text) is None:
        return False
    return ending != ".py" or _defines(text)


def _defines(text: str) -> bool:
    """Tell whether a module defines the function of launch files, or has an error that may hide it."""
    import ast  # noqa: PLC0415 - slow, and only whoever looks for launch files asks

    blocks = (ast.stmt, ast.excepthandler, ast.match_case)
    try:
        with warnings.catch_warnings(action="ignore"):  # told when the file is run
            waiting: list[ast.AST] = [ast.parse(text)]
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return True
    while waiting:
        node = waiting.pop()
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef):
            if node.name == _FUNCTION:
                return True
        elif not isinstance(node, ast.ClassDef):
            waiting += (child for child in ast.iter_child_nodes(node) if isinstance(child, blocks))
    return False


def short_name(name: str) -> str:
    """Return the short name of a launch file: `bringup` for `bringup.launch.py` and `bringup_launch.py`."""
    named = _NAMED.search(name)
    return name[: named.start() + 1] if named else Path(name).stem


def _is_file_name(word: str) -> bool:
    return is_launch_name(word) or Path(word).suffix in _MARKS


def _share(package: str, packages: Packages) -> Path:
    share = packages.share(package)
    if share is not None:
        return Path(share)
    meant = nearest(package, packages.names())
    hint = f": did you mean '{meant}'?" if meant else ""
    if not os.environ.get("AMENT_PREFIX_PATH"):
        hint += " (AMENT_PREFIX_PATH is not set: the setup file of a workspace sets it)"
    raise UsageError(f"there is no package '{package}'{hint}")


def _in_share(share: Path, package: str, name: str) -> str:
    found = _hits(share, name)
    if not found:
        raise UsageError(f"the package '{package}' has no launch file {name}{_hint_in(share, name)}")
    return _only(found, share, f"the package '{package}' has more than one {name}")


def _short(share: Path, package: str, name: str, written: str) -> str:
    """Return the file that one word names; a folder of the package's name beside it may have been meant."""
    found = _hits(share, name)
    if found:
        return _only(found, share, f"more than one launch file is {written}")
    hint = _hint(Path(written)) or _hint_in(share, name)
    raise UsageError(f"there is no launch file {written}, nor has the package '{package}' one{hint}")


def _hits(share: Path, name: str) -> list[Path]:
    """Return the files of that name, else those of that short name, those that are named launch files first."""
    parent, _, last = name.rpartition("/")
    near = [
        path
        for path in sorted(files_below(share))
        if short_name(path.name) == last or path.name == last
        if f"/{path.parent.relative_to(share).as_posix()}".endswith(f"/{parent}" if parent else "")
    ]
    exact = [path for path in near if path.name == last]
    named = [path for path in near if is_launch_name(path.name)]
    return exact or named or [path for path in near if is_launch_file(path)]


def _only(found: list[Path], share: Path, complaint: str) -> str:
    if len(found) > 1:
        raise UsageError(f"{complaint}: {', '.join(str(path.relative_to(share)) for path in found)}")
    return str(found[0])


def _hint_in(share: Path, name: str) -> str:
    names = {word for path in launch_files(share) for word in (path.name, short_name(path.name))}
    meant = nearest(Path(name).name, names)
    return f": did you mean '{meant}'?" if meant else ""


def _listed(share: Path) -> str:
    names = dict.fromkeys(path.name for path in launch_files(share))
    return f"it has {', '.join(names)}" if names else "it has none"


def not_there(written: str) -> UsageError:
    """Return what is to be told of a path that is no launch file."""
    if os.path.lexists(written):
        return UsageError(f"{written} is there, but it is no file")
    return UsageError(f"there is no launch file {written}{_hint(Path(written))}")


def _hint(path: Path) -> str:
    """Return a question about a file in the same folder that was probably meant."""
    folder = path.parent
    try:
        meant = nearest(path.name, [entry.name for entry in folder.iterdir()])
    except OSError:
        return ""
    return f": did you mean {folder / meant}?" if meant else ""


def _beginning(path: Path) -> str:
    try:
        with path.open("rb") as stream:
            return stream.read(_LONGEST_SEARCH).decode("utf-8", "replace")
    except OSError:
        return ""  # whoever reads it by its name will say that it cannot be read

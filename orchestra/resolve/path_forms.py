"""Paths in the forms of other programs: `package://demo/a.yaml`, `$HOME/a.yaml`, and `~/a.yaml` as shells read it.

`~` is read here too. Upstream takes it for the name of a folder, so it is told.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import Code
from orchestra.location import is_file, is_python
from orchestra.patterns import pattern

if TYPE_CHECKING:
    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution

HOME: Final = "~/"
_PACKAGE: Final = pattern(r"package:/{1,3}([A-Za-z]\w*)((?:/.*)?)")
_FILE: Final = pattern(r"file://(?:localhost)?(/.*)")
_VARIABLE: Final = pattern(r"\$(?:\{(\w+)\}|([A-Z]\w*))(.*)")
_WINDOWS: Final = pattern(r"[\w)]\\{1,2}\w")
_PREFIX: Final = pattern(r"\$\(find-pkg-prefix\s+([A-Za-z]\w*)\s*\)/([^$]+)")


def of_share(path: str, written: str) -> str | None:
    """Return a path below the prefix of a package as it is below its share, where the file is; None for any other."""
    found = _PREFIX.fullmatch(written)
    if found is None or not path.endswith(f"/{found[2]}"):
        return None
    there = f"{path.removesuffix(found[2])}share/{found[1]}/{found[2]}"
    return written.replace("find-pkg-prefix", "find-pkg-share") if is_file(there) else None


def form_meant(path: str) -> tuple[str, str] | None:
    """Return what is to be told of a path that is no path here, and how it is written; None for any other."""
    if (found := _PACKAGE.fullmatch(path)) is not None:
        return "'package://' means nothing in a path", f"$(find-pkg-share {found[1]}){found[2]}"
    if (found := _FILE.fullmatch(path)) is not None:
        return "'file://' means nothing in a path", found[1]
    if _WINDOWS.search(path) is not None:
        return "folders are parted by '/'", path.replace("\\\\", "/").replace("\\", "/")
    if (found := _VARIABLE.fullmatch(path)) is not None:
        name = found[1] or found[2]
        return f"'{path[: found.start(3)]}' is read by shells only", f"$(env {name}){found[3]}"
    return None


def warn_of_home(value: Value, written: str, run: Resolution) -> None:
    """Tell of a path that begins with `~`."""
    message = "ROS 2 does not read '~' in a path: it is the name of a folder there"
    rest = written.removeprefix(HOME)
    instead = None if rest == written else f"$(env HOME)/{rest}"
    if is_python(value.location):
        instead = f"os.path.expanduser({value.text!r})"
    run.problems.warning(Code.MISSING_FILE, message, value.location, suggestion=instead)

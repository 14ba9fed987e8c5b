"""Files that the arguments of a program name and that are not there: `-d $(find-pkg-share demo)/rviz/veiw.rviz`.

Programs write files too, so told is only what can hardly be meant: a path beside the launch file, or in a package that
is here, which is near a file that is there; and a file with parameters, without which rcl ends the node at once.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Final

from orchestra.dataclass import dataclass
from orchestra.errors import Code
from orchestra.fields import replace
from orchestra.location import Location, displayed, is_python
from orchestra.nearest import is_slip
from orchestra.patterns import pattern
from orchestra.resolve.misspelt import misspelt
from orchestra.resolve.near_paths import exists, near_names, near_path
from orchestra.resolve.path_forms import warn_of_home
from orchestra.resolve.paths import settled_path
from orchestra.resolve.refusals import set_by_code

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.resolve.context import Value
    from orchestra.resolve.resolution import Resolution

_PARAMETERS: Final = "--params-file"
# What stands before a path that the program is to write.
_WRITES: Final = pattern(r"--?(?:o|O|out.*|log.*|save.*|record.*|dump.*|bag.*|cache.*)")
_NAMED: Final = pattern(r"(?:--?)?[\w./-]*:?=(?=[/.~])|file://")  # `--config=/path`, `map:=/path`


@dataclass(frozen=True, slots=True)
class _Lack:
    """A file that is not there: how a path to one near it is written instead, and where."""

    path: Path
    at: Location
    instead: str | None


def check_files(words: Sequence[Value], run: Resolution, *, for_ros: bool | None = None) -> None:
    """Report files that the words name and that are not there; `for_ros` tells that all words are for rcl."""
    option, reads = "", for_ros is True
    for word in words:
        if "/" in word.text and not _WRITES.fullmatch(option):
            if reads and option == _PARAMETERS and word.text.startswith("~/"):
                warn_of_home(word, word.text if word.raw is None else word.raw, run)
                continue
            lack = _lack(word, run)
            if lack is not None:
                _report(lack, word, run, needed=reads and option == _PARAMETERS)
        option = word.text
        reads = option == "--ros-args" or (reads and option != "--") if for_ros is not None else False


def _report(lack: _Lack, word: Value, run: Resolution, *, needed: bool) -> None:
    told = f"there is no file {displayed(str(lack.path))}"
    if needed and Path(word.text).is_absolute():
        told = f"there is no parameter file {displayed(str(lack.path))}: the node ends at once"
        run.problems.error(Code.MISSING_FILE, told, lack.at, suggestion=lack.instead)
    elif lack.instead is not None:
        used = () if lack.at == word.location else (f"it is used at {word.location}",)
        run.problems.warning(Code.MISSING_FILE, told, lack.at, suggestion=lack.instead, notes=used)


def _lack(word: Value, run: Resolution) -> _Lack | None:
    """Return what is to be told of the file that a word names, None where there is one or it may come."""
    name = _NAMED.match(word.text)
    path = word.text[name.end() :] if name is not None else word.text
    named = word if name is None else replace(word, text=path)
    missing = settled_path(named, run) if _is_path(path) else None
    if missing is None:
        return None
    raw = word.text if word.raw is None else word.raw
    changes = near_names(missing)
    if not all(map(_is_sure, *zip(*changes, strict=True))) if changes else True:
        return _Lack(missing, word.location, None)
    place = None if is_python(word.location) else misspelt(word, raw, changes)
    if place is not None:
        return _Lack(missing, place.at, place.instead)
    origin = set_by_code(word)
    if origin is not None:  # it comes through a variable
        return _Lack(missing, origin, near_path(missing, word.text))
    near = near_path(missing, raw)
    if near == raw:  # what is written are parts of it
        near = near_path(missing, word.text) if is_python(word.location) else None
    return _Lack(missing, word.location, near)


def _is_path(text: str) -> bool:
    """Return whether a text looks like the path of a file; where names in it have blanks, their folders are there."""
    if not _has_ending(text) or any(sign in text for sign in "*?<>|{}\n:;,"):
        return False
    slash = text.find("/", text.rfind(" ") + 1)
    return " " not in text or (text.startswith("/") and slash > 0 and exists(Path(text[:slash])))


def _has_ending(text: str) -> bool:
    name = text.rpartition("/")[2]
    if not name or name.endswith("."):
        return bool(Path(text).suffix)
    return name.rfind(".") > 0


def _is_sure(name: str, near: str) -> bool:
    """Return whether a name is hardly anything but another one mistyped, without a slash, or with another ending."""
    if near.replace("/", "") == name:
        return True
    one, other = (Path(item).name for item in (name, near))
    return one == other or is_slip(one, other) or one.partition(".")[0] == other.partition(".")[0]

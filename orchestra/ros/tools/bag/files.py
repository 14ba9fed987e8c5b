"""Which files a bag has: those that its metadata name, or, where it has none, all MCAP files of its folder."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from orchestra.errors import RunError
from orchestra.nearest import nearest
from orchestra.ros.tools.bag import summary
from orchestra.ros.tools.bag.compressed import SUFFIX

if TYPE_CHECKING:
    from pathlib import Path

_SUFFIXES: Final = (".mcap", f".mcap{SUFFIX}")


def files_of(path: Path) -> tuple[list[Path], str]:
    """Return the storage files of a bag, and of which ROS it is. Raises `RunError`."""
    if path.is_file():
        return [path], summary.UNKNOWN
    about = path / summary.FILE
    if not about.is_file():
        return mcap_files(path), summary.UNKNOWN
    try:
        names, distribution = summary.storage_files(about.read_text("utf-8"))
    except ValueError:
        raise RunError(f"{about} is not what rosbag2 writes") from None
    named = [path / name for name in names]
    other = next((file for file in named if not file.name.endswith(_SUFFIXES)), None)
    if other is not None:
        raise RunError(f"{other} is no MCAP file, and no other storage can be read")
    gone = next((file for file in named if not file.is_file()), None)
    if gone is not None:
        raise RunError(
            f"{gone} is not there, and {about} names it: `orchestra bag reindex {path}` names what is"
        )
    return named, distribution


def mcap_files(path: Path) -> list[Path]:
    """Return the MCAP files of a folder, in order. Raises `RunError` where there are none."""
    if not path.is_dir():
        near = nearest(path.name, _bags(path.parent))
        hint = f"; did you mean {path.with_name(near)}?" if near else ""
        raise RunError(f"there is no bag {path}{hint}")
    files = sorted((file for suffix in _SUFFIXES for file in path.glob(f"*{suffix}")), key=_number)
    if not files:
        raise RunError(f"there is no MCAP file in {path}")
    return files


def _bags(folder: Path) -> list[str]:
    """Return the names of the bags in a folder."""
    if not folder.is_dir():
        return []
    return [
        one.name
        for one in folder.iterdir()
        if (one / summary.FILE).is_file() or (one.is_file() and one.name.endswith(_SUFFIXES))
    ]


def _number(file: Path) -> tuple[int, str]:
    """Return what files of a bag that was split are in order by: the number at the end of their names."""
    number = file.with_name(file.name.removesuffix(SUFFIX)).stem.rpartition("_")[2]
    return (int(number) if number.isdecimal() else 0, file.name)

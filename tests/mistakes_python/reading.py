"""Cases of mistakes, as files beside this one tell them.

`=== NAME` begins a case, `--- FILE` a file of it, `$ WORD` is a word of the command line. What stands before the first
file is that of `main.launch.py`: its actions where it begins with `[`, else the body of its function. `«` and `»` stand
around the text that is to be told, `«wrong→right»` has the suggestion; `??? wrong→right` is on the command line. A name
that ends with `before 3.12` or `from 3.12` is that of a case whose places CPython tells otherwise in other versions,
one with `no blanks` is that of a case whose command is made of paths without quotes: there are other words in it where
the folder of the test has blanks in its name.
"""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path
from textwrap import indent
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

FOLDER: Final = Path(__file__).parent / "cases"
MAIN: Final = "main.launch.py"
_MARK: Final = re.compile(r"«([^»→]*)(?:→([^»]*))?»", re.DOTALL)
_VERSIONS: Final = re.compile(r"(before|from) 3\.(\d+)$")
_HEAD: Final = """\
import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription, events
from launch.actions import *
from launch.conditions import *
from launch.event_handlers import *
from launch.launch_description_sources import *
from launch.substitutions import *
from launch_ros.actions import *
from launch_ros.descriptions import *
from launch_ros.event_handlers import *
from launch_ros.substitutions import *
TALKER = dict(package='demo', executable='talker')

def generate_launch_description():
"""


@dataclass(frozen=True, order=True)
class Told:
    """What is to be told: a range of a file, and what should stand there."""

    file: str
    begin: tuple[int, int]
    end: tuple[int, int]
    suggestion: str | None


@dataclass
class Case:
    """Files with their texts, words of the command line, and what is to be told of them."""

    name: str
    files: dict[str, str] = field(default_factory=dict)
    words: list[str] = field(default_factory=list)
    told: list[Told] = field(default_factory=list)
    suggestions: list[str] = field(default_factory=list)  # for words of the command line

    @property
    def entry(self) -> str:
        """The file that is launched."""
        return next(name for name in self.files if name.startswith("main."))


def cases(path: Path) -> Iterator[Case]:
    """Yield the cases of a file."""
    for text in path.read_text("utf-8").split("=== ")[1:]:
        name, _, body = text.partition("\n")
        if not _is_of_this_version(name):
            continue
        case = Case(f"{path.stem}: {name}")
        first, *others = re.split(r"^--- ", body, flags=re.MULTILINE)
        lines = first.splitlines(keepends=True)
        case.words += [line[2:].strip() for line in lines if line.startswith("$ ")]
        case.suggestions += [line.partition("→")[2].strip() for line in lines if line.startswith("???")]
        own = "".join(line for line in lines if not line.startswith(("$ ", "???")))
        if own:
            _add(case, MAIN, _whole(own))
        for other in others:
            file, _, content = other.partition("\n")
            _add(case, file, content)
        yield case


def _is_of_this_version(name: str) -> bool:
    limit = _VERSIONS.search(name)
    return limit is None or (limit[1] == "from") == (sys.version_info >= (3, int(limit[2])))


def _whole(text: str) -> str:
    body = f"return LaunchDescription({text.rstrip()})\n" if text.startswith("[") else text
    return f"{_HEAD}{indent(body, '    ')}"


def _add(case: Case, file: str, text: str) -> None:
    """Add a file without the marks, and what they say."""
    plain, done = "", 0
    for mark in _MARK.finditer(text):
        plain += text[done : mark.start()]
        begin = _place(plain)
        plain += mark[1]
        case.told.append(Told(file, begin, _place(plain), mark[2]))
        done = mark.end()
    case.files[file] = plain + text[done:]


def _place(text: str) -> tuple[int, int]:
    return text.count("\n") + 1, len(text) - text.rfind("\n")

"""Runs `orchestra` with what it is given, and tells what has been imported in the supervisor before its first program.

counting.py FILE WORDS...    the names of the modules go to FILE; with COUNT_RESOLVER=no it is a mistake to make a plan
"""

import os
import sys
from pathlib import Path
from typing import Any

import orchestra.__main__


def _told(file: str) -> None:
    """Write the names when the first program is about to be started: the interpreter tells of it (PEP 578)."""

    def heard(event: str, _args: tuple[Any, ...]) -> None:
        if event == "os.posix_spawn" and not Path(file).exists():
            Path(file).write_text("\n".join(sorted(sys.modules)))

    sys.addaudithook(heard)


def _never(*_args: object) -> None:
    raise AssertionError("a plan is made")


if os.environ.get("COUNT_RESOLVER") == "no":
    orchestra.__main__._resolve = _never  # type: ignore[assignment]
_told(sys.argv[1])
sys.argv[1:] = sys.argv[2:]
sys.exit(orchestra.__main__.main())

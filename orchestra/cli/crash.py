"""`orchestra crash`: why processes of a run ended that nobody wanted to end."""

from __future__ import annotations

import json
import sys
from typing import TYPE_CHECKING, Any

from orchestra.cli import past, runs
from orchestra.cli.parser import CommandParser
from orchestra.supervise.crash.crashes import FOLDER, REPORT, TEXT
from orchestra.supervise.crash.dossier_text import summary

if TYPE_CHECKING:
    from argparse import Namespace
    from pathlib import Path

_EPILOG = """\
The latest crash is shown, and the others of the run are listed. A process is named as 'orchestra ps' shows it;
'robot1/' is everything in that namespace, '*ekf' a pattern. The folder of a crash holds the same as report.txt and
report.json.
"""


def parser() -> CommandParser:
    """Return what the command understands."""
    made = CommandParser("crash", "Show why processes of a run have ended.", _EPILOG)
    made.add_argument(
        "--run",
        metavar="RUN",
        help="the name of the run, or its directory (default: the one that is alive or was last)",
    )
    made.add_argument("-l", "--list", action="store_true", help="only list what crashed")
    made.add_argument(
        "--format", choices=("text", "json"), default="text", help="json: all of them, latest first"
    )
    made.add_argument("processes", nargs="*", metavar="PROCESS", help="only of these (default: all)")
    return made


def run(options: Namespace) -> int:
    """Show them, the latest first."""
    directory = runs.recorded(options.run)
    wanted = past.selected(options.processes, directory) if options.processes else None
    found = [
        (folder, document)
        for folder, document in _dossiers(directory)
        if wanted is None or document["process"] in wanted
    ]
    if options.format == "json":
        sys.stdout.write(runs.as_json([{"folder": str(folder), **document} for folder, document in found]))
    elif not found:
        runs.told(f"nothing has crashed in {directory.name}")
    else:
        _show(found, only_list=options.list)
    return 0


def _show(found: list[tuple[Path, dict[str, Any]]], *, only_list: bool) -> None:
    folder, _document = found[0]
    listed = found if only_list else found[1:]
    if not only_list:
        sys.stdout.write((folder / TEXT).read_text("utf-8", "replace"))
        sys.stdout.write(f"\nall of it is in {folder}\n")
        if listed:
            sys.stdout.write("\nbefore that\n")
    indent = "" if only_list else "    "
    for other, document in listed:
        sys.stdout.write(f"{indent}{summary(document)}  {other}\n")


def _dossiers(directory: Path) -> list[tuple[Path, dict[str, Any]]]:
    """Return what a run has kept, the latest first; what is just being written or removed is left out."""
    found = []
    for path in (directory / FOLDER).glob(f"*/{REPORT}"):
        try:
            found.append((path.parent, json.loads(path.read_text("utf-8"))))
        except (OSError, ValueError):
            continue
    return sorted(found, key=lambda one: one[1]["ended"], reverse=True)

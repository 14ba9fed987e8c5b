"""What files share is looked at once in a process that is watched, and each result depends on it."""

from __future__ import annotations

import os
import subprocess
import sys
from typing import TYPE_CHECKING

import pytest

from orchestra.nearest import renew
from orchestra.witness.once import real
from orchestra.witness.unknowable import reaches_out

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

_PROGRAM = """
import os, sys
from orchestra.witness.observing import observer
from orchestra.witness.once import once
folder, calls = sys.argv[1], []
def look():
    calls.append(1)
    return os.path.isfile(f"{folder}/file")
watching = observer()
watching.install()
told = []
for unknown in (False, False, True, False):
    watching.begin({})
    if unknown:
        watching.unknown("somebody writes files")
    once(("file",), look)
    record = watching.end()
    told.append((len(calls), f"{folder}/file" in record.whole().looks.get("mode", {})))
print(told)
"""


def test_a_look_is_shared_recorded_and_forgotten(tmp_path: Path) -> None:
    words = [sys.executable, "-c", _PROGRAM, str(tmp_path)]
    done = subprocess.run(words, check=True, capture_output=True, text=True)
    assert done.stdout.strip() == str([(1, True), (1, True), (2, True), (3, True)])


@pytest.mark.parametrize(
    "path",
    [
        *(
            "file",
            "linked",
            "folder/file",
            "folder/linked",
            "within/file",
            "within/linked",
            "missing",
            "missing/x",
        ),
        *("folder", "folder/", "folder/..", "folder/../file", ".", "circle", "circle/x", "file/x", "a\0b"),
    ],
)
def test_where_a_path_leads_to_is_what_the_system_says(
    path: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "file").touch()
    (tmp_path / "folder" / "file").touch()
    (tmp_path / "linked").symlink_to("folder/linked")
    (tmp_path / "folder" / "linked").symlink_to("../file")
    (tmp_path / "within").symlink_to("folder")
    (tmp_path / "circle").symlink_to("circle")
    monkeypatch.chdir(tmp_path)
    for written in (path, f"{tmp_path}/{path}"):
        assert _told(real, written) == _told(os.path.realpath, written)


def test_where_a_folder_leads_to_is_looked_at_anew_for_each_launch_file(tmp_path: Path) -> None:
    (tmp_path / "one").mkdir()
    (tmp_path / "two").mkdir()
    link = tmp_path / "linked"
    for name in ("one", "two"):
        link.unlink(missing_ok=True)
        link.symlink_to(name)
        renew()
        assert real(f"{link}/file") == os.path.realpath(tmp_path / name / "file")


def _told(tell: Callable[[str], str], path: str) -> str:
    try:
        return tell(path)
    except ValueError as error:
        return str(error)


@pytest.mark.parametrize(
    ("expression", "reaches"),
    [
        *(
            ("1 + 1", False),
            ("'a' != 'b'", False),
            ("x", True),
            ("'a'.upper()", True),
            ("[1 for _ in ()]", sys.version_info < (3, 12)),  # from then on it is no code of its own
        ),
        *(("(lambda: 1)()", True), ("f'{1}'", False)),
    ],
)
def test_code_without_a_name_reaches_nothing(expression: str, *, reaches: bool) -> None:
    assert reaches_out(compile(expression, "<string>", "eval")) is reaches

"""What the observer hears of files."""

from __future__ import annotations

import copy
import os
from typing import TYPE_CHECKING

import pytest

from orchestra.witness.observing import Observer
from orchestra.witness.origins import OURS

if TYPE_CHECKING:
    from pathlib import Path

_IMPORTING = "hear('import', ('org', None, [folder], [], []))"


def test_after_a_record_nothing_is_recorded_until_another_one_is_begun() -> None:
    """A check that follows a plan in one process, as tests have it, kept findings that depended on nothing."""
    watching = Observer()
    watching.begin({"A": "1", "B": "2"})
    watching.variable("A")
    watching.rest()
    watching.rest()
    watching.variable("B")
    assert watching.end().variables == {"A": "1"}
    watching.begin({"A": "1", "B": "2"})
    watching.variable("B")
    assert watching.active
    assert watching.end().variables == {"B": "2"}


def test_bytecode_that_is_written_meanwhile_is_no_code_of_ours() -> None:
    """It has another name until it is complete, which is gone when a plan is kept with what made it."""
    watching = Observer()
    watching.begin({})
    watching._heard("open", (f"{OURS}fields.py", "rb", 0))
    watching._heard("open", (f"{OURS}__pycache__/fields.cpython-311.pyc.140", None, os.O_CREAT | os.O_WRONLY))
    assert watching.code == {f"{OURS}fields.py"}
    assert not watching.end().unknown


@pytest.mark.parametrize(
    ("file", "text", "listed"),
    [
        (copy.__file__, _IMPORTING, False),
        (copy.__file__, f"def load():\n    {_IMPORTING}\nload()", True),
        ("/home/user/some.launch.py", _IMPORTING, True),
    ],
    ids=["a module of Python", "a function of Python", "code of users"],
)
def test_what_modules_of_python_try_to_import_is_no_look_at_the_folders(
    tmp_path: Path, file: str, text: str, listed: bool
) -> None:
    """`copy` looks for a module of Jython: two files of a check depended on the names in the working folder."""
    watching = Observer()
    watching.begin({})
    exec(compile(text, file, "exec"), {"hear": watching._heard, "folder": str(tmp_path)})  # noqa: S102 - of a file of Python
    assert ("listing" in watching.end().looks) is listed

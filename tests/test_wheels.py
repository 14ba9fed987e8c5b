"""The wheels change the environment of an interpreter that starts; a plan shows the one in which it was called."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from orchestra.resolve.command_line import inputs_from
from orchestra.wheels import DONE, as_called, library_folders

FOLDERS = library_folders(Path(sys.prefix))


@pytest.mark.parametrize(
    ("added", "called"),
    [(FOLDERS, {}), ((*FOLDERS[::-1], "/mine"), {"LD_LIBRARY_PATH": "/mine"}), ((), {})],
    ids=["no-path", "path-of-the-caller", "nothing-added"],
)
def test_what_the_wheels_have_added_is_taken_away(added: tuple[str, ...], called: dict[str, str]) -> None:
    environment = {"A": "1", DONE: "1", **({"LD_LIBRARY_PATH": ":".join(added)} if added else {})}
    assert as_called(environment) == {"A": "1", **called}
    assert inputs_from((), environment=environment).environment == {"A": "1", **called}


def test_an_environment_without_the_wheels_stays_as_it_is() -> None:
    environment = {"LD_LIBRARY_PATH": "/opt/ros/lib:/opt/lib"}
    assert as_called(environment) == environment

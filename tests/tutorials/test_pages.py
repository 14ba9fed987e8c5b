"""Each page of the tutorials can be followed: what it has typed is typed, and what it shows is seen."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest

from orchestra.testing.domain import free_domain
from tests.tutorials.learner import Learner
from tests.tutorials.pages import Command, File, steps

_PAGES = Path(__file__).parents[2] / "docs" / "tutorials"
# It has all of the bringup run, as other tests do.
_LONG = {"robots.md"}
PAGES = sorted(path.name for path in _PAGES.glob("*.md") if path.name != "README.md")


@pytest.mark.timeout(600)
@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.long) if name in _LONG else name for name in PAGES]
)
def test_a_page_can_be_followed(name: str, tmp_path: Path) -> None:
    pytest.importorskip("rclpy", reason="needs ROS")
    folder = tmp_path / "tutorials"
    shutil.copytree(_PAGES, folder, ignore=shutil.ignore_patterns("*.md", "__pycache__"))
    with free_domain({}) as domain, ExitStack() as lasting:
        environment = {
            **os.environ,
            "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ORCHESTRA_HOME": str(tmp_path / "home"),
            "NO_COLOR": "1",
        }
        lasting.callback(_end_runs, environment)
        learner = Learner(folder, tmp_path / "state", environment, lasting)
        for step in steps((_PAGES / name).read_text()):
            if isinstance(step, File):
                learner.save(step)
            else:
                learner.type(step)


def _end_runs(environment: dict[str, str]) -> None:
    """End what a page has left where its last steps were not taken."""
    subprocess.run(["orchestra", "down", "--all"], env=environment, capture_output=True, check=False)


def test_the_first_page_names_them_all() -> None:
    contents = (_PAGES / "README.md").read_text()
    assert [name for name in PAGES if f"({name})" not in contents] == []


@pytest.mark.parametrize(
    ("shown", "output", "fits"),
    [
        (("one", "...", "three"), "one\ntwo\n2\nthree\n", True),
        (("one", "...", "three"), "one\nthree\n", True),
        (("at ... Hz",), "at 10.2 Hz\n", True),
        (("one",), "one\ntwo\n", False),
        (("one", "..."), "two\n", False),
        (("a+b",), "aab\n", False),
    ],
)
def test_what_is_seen_is_compared(shown: tuple[str, ...], output: str, fits: bool) -> None:
    assert Command("", shown, interrupted=False, elsewhere=False).fits(output) == fits

"""A command line without options comes to what argparse makes of it."""

from __future__ import annotations

import subprocess
import sys

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.cli import launch
from orchestra.cli.plain import Unasked
from orchestra.errors import UsageError

_WORDS = st.lists(st.text(max_size=8).filter(lambda word: not word.startswith("-")), max_size=4)


@given(_WORDS)
def test_without_options_there_are_the_same(words: list[str]) -> None:
    assert vars(launch.read(words)) == vars(launch.parser().read(words))


@pytest.mark.parametrize(
    "words",
    [["a.launch.py", "--strict"], ["-d", "a.launch.py"], ["a", "--", "b"], ["a", "--name", "n", "x:=1"]],
)
def test_options_are_read_by_argparse(words: list[str]) -> None:
    assert vars(launch.read(words)) == vars(launch.parser().read(words))


def test_mistakes_are_told_as_ever() -> None:
    with pytest.raises(UsageError):
        launch.read(["a.launch.py", "--strickt"])


def test_each_kind_of_option_is_what_nobody_gave() -> None:
    unasked = Unasked()
    unasked.add_argument("-a", "--all-of-it", action="store_true")
    unasked.add_mutually_exclusive_group().add_argument("--one", "--other", default=3)
    unasked.add_argument("--named", dest="known")
    unasked.add_argument("words", nargs="*")
    assert vars(unasked.options(["w"])) == {"all_of_it": False, "one": 3, "known": None, "words": ["w"]}


def test_argparse_is_not_imported_for_it() -> None:
    program = (
        "import sys; from orchestra.cli.launch import read; read(['a']); print('argparse' in sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], check=True, capture_output=True, text=True, timeout=60
    )
    assert done.stdout == "False\n"

"""A plain command line comes to what argparse makes of it."""

from __future__ import annotations

import subprocess
import sys
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from orchestra.cli import check, launch, plan
from orchestra.cli.plain import plain
from orchestra.errors import UsageError

_COMMANDS = {"launch": launch, "plan": plan, "check": check}
_GIVEN = (
    *("a.launch.py", "x:=1", "x:=-1", "", " ", "=", "a b", "-", "--", "-5", "text", "json", "any", "none"),
    *("--strict", "--strict=yes", "--stric", "-d", "-dn", "-s", "-p", "--debug", "--show-args", "--no-cache"),
    *("--format", "--format=json", "--format=", "--format=jsn", "--severity", "--severity=ORC001=off", "-h"),
    *("--params-file", "--node", "--node=/a", "--diff", "--explain", "--jobs", "--jobs=2", "--notes=all"),
    *("--fail-on", "--time-limit", "--portable", "--name", "--name=n", "-a", "-a=b", "--exit-code", "--host"),
)
_WORDS = st.lists(st.sampled_from(_GIVEN) | st.text(max_size=8), max_size=5)


def _by_argparse(command: Any, words: list[str]) -> dict[str, Any] | None:
    try:
        return vars(command.parser().read(words))
    except (UsageError, SystemExit):
        return None


@given(st.sampled_from(sorted(_COMMANDS)), _WORDS)
def test_what_is_read_without_argparse_is_the_same(name: str, words: list[str]) -> None:
    command: Any = _COMMANDS[name]
    read = plain(words, command._add_to)
    assert read is None or vars(read) == _by_argparse(command, words)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        *(("launch", words) for words in ("a.launch.py", "a b x:=1", "a --debug", "-a a", "--name n a x:=1")),
        *(
            ("plan", words)
            for words in ("a --format json", "--format=dot a", "a --node /a --node /b --strict")
        ),
        *(("check", words) for words in (". --format sarif", "a b --notes all", "--severity ORC001=off .")),
    ],
)
def test_what_is_plain_is_read_without_argparse(name: str, words: str) -> None:
    command: Any = _COMMANDS[name]
    read = plain(words.split(), command._add_to)
    assert read is not None
    assert vars(read) == _by_argparse(command, words.split())


def test_mistakes_are_told_as_ever() -> None:
    with pytest.raises(UsageError):
        launch.read(["a.launch.py", "--strickt"])


def test_each_kind_of_option_is_what_nobody_gave() -> None:
    def add_to(made: Any) -> None:
        made.add_argument("-a", "--all-of-it", action="store_true")
        made.add_mutually_exclusive_group().add_argument("--one", "--other", default=3)
        made.add_argument("--named", dest="known")
        made.add_argument("words", nargs="*")

    read = plain(["w"], add_to)
    assert read is not None
    assert vars(read) == {"all_of_it": False, "one": 3, "known": None, "words": ["w"]}


@pytest.mark.parametrize("name", sorted(_COMMANDS))
def test_argparse_is_not_imported_for_it(name: str) -> None:
    program = f"import sys; from orchestra.cli.{name} import read; read(['a', '--strict']); print('argparse' in sys.modules)"
    done = subprocess.run(
        [sys.executable, "-P", "-c", program], check=True, capture_output=True, text=True, timeout=60
    )
    assert done.stdout == "False\n"

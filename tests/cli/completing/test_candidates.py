"""What may stand at the cursor, by the words before it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.cli.commands import COMMANDS
from orchestra.cli.completing.answers import answer
from orchestra.cli.completing.command_line import candidates
from orchestra.errors import UsageError

if TYPE_CHECKING:
    from pathlib import Path

_OUTER = """\
launch:
  - arg: {name: robot, description: "which\\none"}
  - arg: {name: mode, default: $(env MODE x)}
  - arg: {name: map, default: ""}
  - include: {file: inner.launch.yaml, if: $(var robot), arg: [{name: given, value: x}]}
"""
_INNER = """\
launch:
  - arg: {name: given}
  - arg: {name: speed, default: "1.5"}
  - arg: {name: loud, default: "False"}
"""


@pytest.fixture(autouse=True)
def _surroundings(folder: Path, prefix: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(folder)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    (folder / "outer.launch.yaml").write_text(_OUTER)
    (folder / "inner.launch.yaml").write_text(_INNER)
    (folder / "plain.yaml").write_text("a: 1\n")
    (folder / "marked.yaml").write_text("launch: []\n")
    (folder / "maps").mkdir()
    (folder / ".hidden").mkdir()
    share = prefix / "share" / "demo"
    (share / "launch" / "talk_launch.xml").write_text("<launch/>")
    (share / "launch" / "both.launch.xml").write_text("<launch/>")
    (share / "launch" / "both.launch.py").write_text("")
    (share / "package.xml").write_text("<package/>")
    (prefix / "share" / "demo" / "config.yaml").write_text("a: 1\n")


def _words(*words: str) -> list[str]:
    *before, begun = words
    return [item.word for item in candidates(before, begun)]


def test_commands_come_first() -> None:
    assert _words("") == list(COMMANDS)
    assert _words("--") == ["--help", "--version"]


@pytest.mark.conforms("5.3 completion", "5.2 completion")
@pytest.mark.parametrize("command", ["launch", "plan", "check"])
def test_launch_files_folders_and_packages_of_this_place(command: str) -> None:
    found = _words(command, "")
    assert found[:4] == ["inner.launch.yaml", "maps/", "marked.yaml", "outer.launch.yaml"]
    assert "demo" in found[4:]


@pytest.mark.conforms("5.2 completion")
@pytest.mark.parametrize("command", ["launch", "plan", "check"])
def test_launch_files_of_a_package(command: str) -> None:
    assert [word for word in _words(command, "demo", "") if word.endswith((".py", ".xml"))] == [
        "both.launch.py",
        "both.launch.xml",
        "talk_launch.xml",
    ]
    assert _words(command, "demo/") == ["demo/talk"]


@pytest.mark.parametrize("words", [("launch",), ("plan", "--strict"), ("launch", "--name", "x", "-a")])
def test_arguments_that_are_not_given_yet(words: tuple[str, ...]) -> None:
    """Those of includes too, but not what the include itself gives."""
    assert _words(*words, "outer.launch.yaml", "") == ["robot:=", "mode:=", "map:=", "speed:=", "loud:="]
    assert _words(*words, "outer.launch.yaml", "mode:=1", "-d", "m") == ["map:="]


def test_arguments_are_described() -> None:
    assert [
        (item.word, item.description, item.open) for item in candidates(["launch", "outer.launch.yaml"], "")
    ][:3] == [
        ("robot:=", "which\none (required)", True),
        ("mode:=", "(default: $(env MODE x))", True),
        ("map:=", "(default: )", True),
    ]
    assert answer("fish", ["launch", "outer.launch.yaml", "rob"]) == "robot:=\twhich one (required)\n"


@pytest.mark.parametrize(
    ("begun", "expected"),
    [
        ("speed:=", ["speed:=1.5"]),
        ("loud:=", ["loud:=True", "loud:=False"]),
        ("loud:=T", ["loud:=True"]),
        ("mode:=m", ["mode:=maps/", "mode:=marked.yaml"]),
        ("mode:=./m", ["mode:=./maps/", "mode:=./marked.yaml"]),
        ("speed:=./ma", ["speed:=./maps/", "speed:=./marked.yaml"]),
        ("unknown:=ma", ["unknown:=maps/", "unknown:=marked.yaml"]),
    ],
)
def test_values_of_an_argument(begun: str, expected: list[str]) -> None:
    assert _words("launch", "outer.launch.yaml", begun) == expected


def test_files_after_an_option_that_wants_one() -> None:
    assert _words("launch", "--params-file", "pl") == ["plain.yaml"]
    assert _words("launch", "--params-file=pl") == ["--params-file=plain.yaml"]
    assert _words("launch", "--name", "") == []


def test_options() -> None:
    found = _words("launch", "outer.launch.yaml", "--")
    assert {"--params-file", "--format", "--debug", "--launch-prefix", "--print"} <= set(found)
    assert "--debug" not in _words("launch", "-d", "--")  # it is given, by its other name
    assert "--params-file" in _words("launch", "--params-file", "x", "--")  # may be given again
    assert _words("launch", "--", "x", "--") == []


def test_words_of_the_node_are_the_nodes() -> None:
    assert _words("run", "demo", "") == ["echo", "talker"]
    assert _words("run", "demo", "talker", "--") == []
    assert _words("run", "demo", "talker", "pla") == ["plain.yaml"]
    assert "--prefix" in _words("run", "--")


def test_arguments_of_what_is_checked() -> None:
    assert _words("check", "outer.launch.yaml", "spe") == ["speed:="]


@pytest.mark.parametrize(
    "words",
    [("nothing", ""), ("launch", "nowhere.yaml", ""), ("schema", "plan", ""), ("launch", "~nobody_here/")],
)
def test_nothing_is_made_up(words: tuple[str, ...]) -> None:
    assert _words(*words) == []


@pytest.mark.parametrize(("shell", "question"), [("tcsh", []), ("bash", ["x", "y", "z"]), ("bash", [])])
def test_what_no_hook_asks_is_refused(shell: str, question: list[str]) -> None:
    with pytest.raises(UsageError):
        answer(shell, question)


def test_bash_counts_bytes() -> None:
    text = "orchestra launch 'é' --par and more"
    point = str(len(text.encode()) - len(" and more"))
    assert answer("bash", [point, text, ":="]) == "--params-file \n"


def test_a_name_with_a_line_break_is_left_out(folder: Path) -> None:
    (folder / "a\nb.launch.yaml").write_text("launch: []\n")
    assert answer("fish", ["launch", "a"]).count("launch.yaml") == 0

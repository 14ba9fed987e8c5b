"""`orchestra plan A --diff B` and `orchestra plan FILE --explain SUBJECT`."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from subprocess import CompletedProcess
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from pathlib import Path

Command = Callable[..., CompletedProcess[str]]


@pytest.fixture
def orchestra(orchestra_here: Command) -> Command:
    """Run the command in this process."""
    return orchestra_here


_OUTER = """\
launch:
  - arg: {name: who, default: world}
  - include: {file: parts/inner.yaml, arg: [{name: who, value: $(var who)}]}
"""
_INNER = """\
launch:
  - arg: {name: who}
  - executable: {cmd: "echo hello $(var who)", name: greet}
  - node: {pkg: demo, exec: talker, name: talker, param: [{from: p.yaml}]}
"""


@pytest.fixture(autouse=True)
def _files(folder: Path, prefix: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    (folder / "parts").mkdir()
    (folder / "outer.yaml").write_text(_OUTER)
    (folder / "parts" / "inner.yaml").write_text(_INNER)
    (folder / "parts" / "p.yaml").write_text("/**:\n  ros__parameters: {rate: 1}\n")


def _data(found: CompletedProcess[str]) -> Any:
    assert (found.returncode, found.stderr) == (0, "")
    return json.loads(found.stdout)


def _fates(found: CompletedProcess[str]) -> dict[str, str]:
    return {item["id"]: item["fate"] for item in _data(found)["processes"]}


def test_two_sets_of_arguments(orchestra: Command) -> None:
    for words in (("outer.yaml", "who:=moon"), ("who:=moon",)):
        found = orchestra("plan", "outer.yaml", "who:=sun", "--diff", *words, "--format", "json")
        assert _fates(found) == {"greet": "restart"}
        (change,) = _data(found)["processes"][0]["changes"]
        assert (change["before"], change["after"]) == (["moon"], ["sun"])
    assert _data(found)["before"] == "outer.yaml who:=moon"


def test_the_same_file_without_words_is_meant_without_arguments(orchestra: Command) -> None:
    found = orchestra("plan", "outer.yaml", "who:=sun", "--diff", "outer.yaml", "--format", "json")
    assert _fates(found) == {"greet": "restart"}
    assert _data(found)["before"] == "outer.yaml"


def test_two_files_with_the_same_arguments(orchestra: Command, folder: Path) -> None:
    (folder / "other.yaml").write_text(_OUTER.replace("world", "nobody"))
    assert _fates(orchestra("plan", "outer.yaml", "--diff", "other.yaml", "--format", "json")) == {
        "greet": "restart"
    }
    same = orchestra("plan", "outer.yaml", "who:=x", "--diff", "other.yaml", "--format", "json")
    assert _data(same)["processes"] == []


@pytest.mark.parametrize("form", ["json", "yaml"])
@pytest.mark.parametrize("portable", [False, True])
def test_a_file_against_a_saved_plan(orchestra: Command, folder: Path, form: str, portable: bool) -> None:
    options = ("--portable",) if portable else ()
    saved = orchestra("plan", "outer.yaml", "--format", form, *options)
    (folder / f"saved.{form}").write_text(saved.stdout)
    same = orchestra("plan", "outer.yaml", "--diff", f"saved.{form}", "--exit-code")
    assert (same.returncode, same.stdout.endswith("\nno difference\n")) == (0, True)
    (folder / "parts" / "p.yaml").write_text("/**:\n  ros__parameters: {rate: 2}\n")
    found = orchestra("plan", "outer.yaml", "--diff", f"saved.{form}", "--exit-code")
    assert (found.returncode, found.stderr) == (1, "")
    assert "! /talker restarts" in found.stdout
    assert "      - 1  (parts/p.yaml:2:27, included from parts/inner.yaml:4:" in found.stdout
    assert "      + 2  (parts/p.yaml:2:27, included from parts/inner.yaml:4:" in found.stdout


def _git(folder: Path, *words: str) -> None:
    own = ("-c", "user.name=x", "-c", "user.email=x@y", "-c", "commit.gpgsign=false")
    subprocess.run(["git", *own, *words], cwd=folder, check=True, capture_output=True, timeout=60)


@pytest.fixture
def repository(folder: Path) -> Path:
    """The folder as a repository: what it has is its first revision, then everything in it is other than before."""
    _git(folder, "init", "-q", "-b", "main")
    (folder / ".gitattributes").write_text("parts export-ignore\n")
    _git(folder, "add", ".")
    _git(folder, "commit", "-q", "-m", "first")
    _git(folder, "tag", "v1")
    (folder / "parts" / "inner.yaml").write_text(_INNER.replace("hello", "goodbye"))
    (folder / "parts" / "p.yaml").write_text("/**:\n  ros__parameters: {rate: 2}\n")
    _git(folder, "commit", "-q", "-a", "-m", "second")
    return folder


@pytest.mark.parametrize("revision", ["HEAD~1", "v1", "v1:outer.yaml", "main~1"])
def test_a_file_against_a_revision_with_all_that_it_includes(
    orchestra: Command, repository: Path, revision: str
) -> None:
    found = orchestra("plan", "outer.yaml", "--diff", revision, "--format", "json")
    assert _fates(found) == {"greet": "restart", "/talker": "restart"}
    (change,) = _data(found)["processes"][1]["changes"]
    assert (change["before"], change["after"]) == (1, 2)
    assert change["before_at"]["file"] == change["after_at"]["file"] == "parts/p.yaml"
    assert "orchestra-revision" not in found.stdout
    status = subprocess.run(
        ["git", "status", "--porcelain"], cwd=repository, capture_output=True, check=True, timeout=60
    )
    assert status.stdout == b""


def test_the_revision_of_now_is_no_difference(orchestra: Command, repository: Path) -> None:
    assert orchestra("plan", "outer.yaml", "--diff", "HEAD", "--exit-code").returncode == 0
    (repository / "outer.yaml").write_text(_OUTER.replace("world", "all"))
    assert orchestra("plan", "outer.yaml", "--diff", "HEAD", "--exit-code").returncode == 1
    assert orchestra("plan", "outer.yaml", "who:=x", "--diff", "HEAD", "who:=x").returncode == 0


def test_paths_of_the_revision_are_those_of_the_working_tree(orchestra: Command, repository: Path) -> None:
    """Whatever a plan says of where its files are is no difference."""
    (repository / "there.yaml").write_text(
        'launch:\n  - executable: {cmd: "cat $(dirname)/outer.yaml", cwd: $(dirname), name: show}\n'
    )
    _git(repository, "add", ".")
    _git(repository, "commit", "-q", "-m", "third")
    found = orchestra("plan", "there.yaml", "--diff", "HEAD", "--exit-code")
    assert found.returncode == 0, found.stdout


def test_packages_of_the_repository_are_those_of_the_revision(
    orchestra: Command, repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(repository)
    package = repository / "here"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "p.yaml").write_text("/**:\n  ros__parameters: {size: 1}\n")
    (repository / "found.yaml").write_text(
        "launch:\n  - node: {pkg: demo, exec: talker, name: n, param: [{from: $(find-pkg-share here)/p.yaml}]}\n"
    )
    _git(repository, "add", ".")
    _git(repository, "commit", "-q", "-m", "third")
    (package / "p.yaml").write_text("/**:\n  ros__parameters: {size: 2}\n")
    found = orchestra("plan", "found.yaml", "--diff", "HEAD", "--format", "json")
    (change,) = _data(found)["processes"][0]["changes"]
    assert (change["before"], change["after"]) == (1, 2)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--diff", "v1:nothing.yaml"), "there is no nothing.yaml in v1"),
        (("--diff", "nothing.yaml"), "nothing.yaml"),
        (("--exit-code",), "--exit-code goes with --diff"),
        (("--portable", "--format", "sh"), "a portable plan cannot be run"),
        (("--diff", "who:=x", "--format", "sh"), "--diff answers as text or json"),
        (("--explain", "greet", "--format", "yaml"), "--explain answers as text or json"),
        (("--explain", "greet", "--diff", "HEAD"), "not allowed with"),
        (("--explain", "gret"), "did you mean 'greet'?"),
        (("--explain", "talker.rat"), "did you mean 'rate'?"),
    ],
)
def test_what_makes_no_sense_is_refused(
    orchestra: Command, repository: Path, words: tuple[str, ...], told: str
) -> None:
    found = orchestra("plan", "outer.yaml", *words)
    assert (found.returncode, found.stdout) == (2, "")
    assert told in found.stderr
    assert repository.exists()


def test_a_saved_plan_takes_no_arguments(orchestra: Command, folder: Path) -> None:
    (folder / "saved.json").write_text(orchestra("plan", "outer.yaml", "--format", "json").stdout)
    for words in (("saved.json", "who:=x"), ("outer.yaml", "--diff", "saved.json", "who:=x")):
        found = orchestra("plan", *words)
        assert (found.returncode, found.stdout) == (2, "")
        assert "saved.json is a saved plan, which takes no who:=x" in found.stderr


def test_a_mistake_in_the_words_behind_diff_is_shown_in_them(orchestra: Command) -> None:
    found = orchestra("plan", "outer.yaml", "who:=sun", "--diff", "whoo:=x")
    assert (found.returncode, found.stdout) == (2, "")
    assert "    1 | whoo:=x\n      | ^^^^\nhelp: did you mean 'who'?" in found.stderr


def test_errors_in_the_revision_are_told_as_those_of_the_revision(
    orchestra: Command, repository: Path
) -> None:
    (repository / "outer.yaml").write_text("launch:\n  - nod: {}\n")
    _git(repository, "commit", "-q", "-a", "-m", "broken")
    (repository / "outer.yaml").write_text(_OUTER)
    found = orchestra("plan", "outer.yaml", "--diff", "HEAD")
    assert (found.returncode, found.stdout) == (2, "")
    assert "HEAD:outer.yaml has errors: " in found.stderr
    assert " at outer.yaml:2:5" in found.stderr


def test_nodes_of_either_plan_can_be_chosen(orchestra: Command, folder: Path) -> None:
    (folder / "more.yaml").write_text(_OUTER + '  - executable: {cmd: "true", name: more}\n')
    for pair in (("more.yaml", "outer.yaml"), ("outer.yaml", "more.yaml")):
        found = orchestra("plan", pair[0], "--node", "more", "--format", "json", "--diff", pair[1])
        assert list(_fates(found)) == ["more"]


def test_a_value_is_explained_as_text_and_as_json(orchestra: Command) -> None:
    shown = orchestra("plan", "outer.yaml", "--explain", "/talker.rate")
    assert (shown.returncode, shown.stderr) == (0, "")
    assert "    -> 1\n         set for '/**'\n" in shown.stdout
    found = _data(
        orchestra(
            "plan",
            "outer.yaml",
            "--explain",
            "talker",
            "--explain",
            "greet$HOME",
            "--format",
            "json",
            HOME="/h",
        )
    )
    assert [item["id"] for item in found["explained"]] == ["/talker", "greet"]
    assert found["explained"][1]["values"][0]["value"] == "/h"


def test_a_new_file_against_an_old_one_that_had_another_name(orchestra: Command, repository: Path) -> None:
    (repository / "outer.yaml").rename(repository / "new.yaml")
    found = orchestra("plan", "new.yaml", "--diff", "v1:outer.yaml", "--format", "json")
    assert _fates(found) == {"greet": "restart", "/talker": "restart"}


def test_files_of_packages_are_compared_too(orchestra: Command, prefix: Path) -> None:
    share = prefix / "share" / "demo" / "launch"
    for name, word in (("one", "x"), ("two", "y")):
        (share / f"{name}.launch.yaml").write_text(
            f"launch:\n  - arg: {{name: a, default: b}}\n  - executable: {{cmd: echo {word} $(var a), name: e}}\n"
        )
    for words in (("demo", "two.launch.yaml"), ("demo/two",)):
        found = orchestra("plan", "demo", "one.launch.yaml", "a:=c", "--format", "json", "--diff", *words)
        (change,) = _data(found)["processes"][0]["changes"]
        assert (change["before"], change["after"]) == (["y"], ["x"])


def test_parameters_of_the_command_line_are_those_of_both(orchestra: Command, folder: Path) -> None:
    (folder / "over.yaml").write_text("/**:\n  ros__parameters: {rate: 9}\n")
    found = orchestra(
        *("plan", "outer.yaml", "who:=x", "--params-file", "over.yaml", "--format", "json"),
        *("--diff", "who:=y", "talker:rate:=3"),
    )
    assert _fates(found) == {"greet": "restart", "/talker": "restart"}
    (change,) = _data(found)["processes"][1]["changes"]
    assert (change["before"], change["after"]) == (3, 9)
    assert change["before_at"]["file"] == "command line"


def test_a_revision_that_there_is_not_is_told_as_such(orchestra: Command, repository: Path) -> None:
    found = orchestra("plan", "outer.yaml", "--diff", "HEAD~999")
    assert found.returncode == 2
    told = f"'HEAD~999' is no launch file, no saved plan and no git revision of {repository}"
    assert found.stderr.startswith(f"error: {told}\n")
    gone = orchestra("plan", "outer.yaml", "--diff", "gone.launch.yaml")
    assert "there is no launch file gone.launch.yaml" in gone.stderr

"""Compiled code of Python launch files is kept for later plans, and makes no plan another one."""

from __future__ import annotations

import marshal
import os
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from orchestra.compat import looks
from orchestra.errors import Problems, Severity
from orchestra.pipeline import collect, inputs_from
from orchestra.plan.codec import dumps
from orchestra.resolve.python import codes as module
from orchestra.resolve.python import forms, numbered
from orchestra.resolve.python.codes import Codes
from orchestra.witness.digest import digest_of

if TYPE_CHECKING:
    from collections.abc import Callable

_FILES = 8
_NODES = 30
_TOP = """\
import os
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription

def generate_launch_description():
    here = os.path.dirname(__file__)
    parts = sorted(name for name in os.listdir(here) if name.startswith("part"))
    return LaunchDescription([
        DeclareLaunchArgument("rate", default_value="1"),
        *(IncludeLaunchDescription(os.path.join(here, name)) for name in parts),
    ])
"""
_PART = """\
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from launch.substitutions import LaunchConfiguration

def generate_launch_description():
    rate = LaunchConfiguration("rate")
    return LaunchDescription([
{processes}    ])
"""
_PROCESS = '        ExecuteProcess(cmd=["true", "{name}", rate, LaunchConfiguration("nobody{name}", default="x")]),\n'


class Tree:
    """Some launch files, and a place for what is kept of them."""

    def __init__(self, folder: Path) -> None:
        self.top = folder / "top.launch.py"
        self.cache = folder / "cache"
        self.parts = [folder / f"part{number}.launch.py" for number in range(_FILES)]
        self.top.write_text(_TOP)
        for number, part in enumerate(self.parts):
            self.write(part, f"n{number}_")

    def write(self, part: Path, name: str) -> None:
        """Write a file that starts some processes."""
        processes = "".join(_PROCESS.format(name=f"{name}{number}") for number in range(_NODES))
        part.write_text(_PART.format(processes=processes))

    def plan(self, *words: str, keeping: bool = True) -> str:
        """Return the plan, with its places and warnings."""
        problems = Problems()
        given = inputs_from(words, environment=dict(os.environ))
        plan = collect(str(self.top), replace(given, keeping=keeping), problems)
        assert plan is not None
        assert not problems.errors
        return dumps(plan)

    @property
    def kept(self) -> list[Path]:
        """The files in which codes are kept."""
        return sorted((self.cache / "codes").glob("*"))


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Tree:
    made = Tree(tmp_path)
    monkeypatch.setenv("ORCHESTRA_CACHE", str(made.cache))
    return made


@pytest.fixture
def compiled(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Return the names of files that are compiled from here on, as if each plan were made by a new process."""
    names: list[str] = []
    compile_ = module._compiled.__wrapped__

    def counted(path: str, source: bytes) -> Any:
        names.append(Path(path).name)
        return compile_(path, source)

    monkeypatch.setattr(module, "_compiled", counted)
    return names


def test_the_second_plan_compiles_nothing_and_is_the_same(tree: Tree, compiled: list[str]) -> None:
    first = tree.plan()
    assert len(compiled) == 1 + _FILES
    assert tree.plan() == first
    assert tree.plan("rate:=2") != first
    assert len(compiled) == 1 + _FILES


def test_only_what_has_changed_is_compiled(tree: Tree, compiled: list[str]) -> None:
    tree.plan()
    compiled.clear()
    tree.write(tree.parts[3], "other_")
    changed = tree.plan()
    assert compiled == ["part3.launch.py"]
    assert changed == tree.plan(keeping=False)
    assert '"other_7"' in changed


def test_many_changes_are_kept_with_what_was_kept_before(tree: Tree, compiled: list[str]) -> None:
    tree.plan()
    for part in tree.parts[1:]:
        tree.write(part, "other_")
    changed = tree.plan()
    compiled.clear()
    assert tree.plan() == changed
    assert not compiled
    assert len(tree.kept) == 1


def test_nothing_is_kept_where_nobody_wants_it(tree: Tree) -> None:
    tree.plan(keeping=False)
    assert not tree.kept


def test_little_is_not_worth_a_file(tree: Tree) -> None:
    for part in tree.parts[1:]:
        part.unlink()
    tree.plan()
    assert not tree.kept


def test_files_are_for_their_owner_alone_and_there_is_room_for_so_many(
    tree: Tree, monkeypatch: pytest.MonkeyPatch
) -> None:
    tree.plan()
    (kept,) = tree.kept
    assert kept.stat().st_mode & 0o777 == 0o600
    monkeypatch.setattr(module, "_MOST", kept.stat().st_size // 2)
    for part in tree.parts:
        tree.write(part, "other_")
    tree.plan()
    assert not tree.kept


def test_a_tree_that_is_too_large_keeps_what_it_has_last_used(
    tree: Tree, compiled: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    tree.plan()
    (kept,) = tree.kept
    monkeypatch.setattr(module, "_MOST_OF_A_TREE", int(1.2 * kept.stat().st_size))
    for number, part in enumerate(tree.parts):
        tree.write(part.rename(part.with_name(f"part_{number}.launch.py")), "other_")
    tree.plan()
    compiled.clear()
    tree.plan()
    assert not compiled
    monkeypatch.setattr(module, "_MOST_OF_A_TREE", kept.stat().st_size // 2)
    tree.plan()
    assert len(compiled) == 1 + _FILES


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-10])


def _written_over(path: Path) -> None:
    content = path.read_bytes()
    path.write_bytes(content[:400] + b"?" + content[401:])


def _open_to_others(path: Path) -> None:
    path.chmod(0o620)


def _of_another_tree(path: Path) -> None:
    body = marshal.dumps(("somebody else", {}))
    path.write_bytes(digest_of(body).encode() + b"\n" + body)


def _no_codes(path: Path) -> None:
    body = b"?"
    path.write_bytes(digest_of(body).encode() + b"\n" + body)


@pytest.mark.parametrize("spoil", [_cut, _written_over, _open_to_others, _of_another_tree, _no_codes])
def test_what_is_damaged_or_not_ours_counts_as_none(
    tree: Tree, compiled: list[str], spoil: Callable[[Path], None]
) -> None:
    first = tree.plan()
    compiled.clear()
    spoil(tree.kept[0])
    assert tree.plan() == first
    assert len(compiled) == 1 + _FILES


@pytest.mark.parametrize(
    ("name", "value"),
    [("version", "3.99"), ("warnoptions", ["error"]), ("_xoptions", {"no_debug_ranges": True})],
)
def test_another_interpreter_has_codes_of_its_own(
    tree: Tree, compiled: list[str], monkeypatch: pytest.MonkeyPatch, name: str, value: Any
) -> None:
    tree.plan()
    monkeypatch.setattr(sys, name, value)
    tree.plan()
    assert len(compiled) == 2 * (1 + _FILES)


def test_code_that_warns_is_compiled_each_time(tree: Tree, compiled: list[str]) -> None:
    tree.plan()
    for part in tree.parts:
        tree.write(part, "other_")
    tree.parts[0].write_text(tree.parts[0].read_text() + "\nassert (1, 'always true')\n")
    for _ in range(2):
        compiled.clear()
        with pytest.warns(SyntaxWarning, match="assertion is always true"):
            tree.plan()
    assert compiled == ["part0.launch.py"]


def test_where_the_disk_refuses_nothing_is_kept(tree: Tree) -> None:
    tree.cache.write_text("a file in place of the folder")
    assert tree.plan() == tree.plan(keeping=False)


def test_positions_in_kept_code_are_those_of_the_file(tree: Tree) -> None:
    for part in tree.parts:
        part.write_text(part.read_text().replace('"nobodyn3_5"', '"nobodyn3_5", defualt="y"'))
    found = []
    for _ in range(2):
        problems = Problems()
        collect(str(tree.top), inputs_from((), environment=dict(os.environ)), problems)
        found.append(problems.ordered)
        module._compiled.cache_clear()
    assert found[0] == found[1]
    (problem,) = [problem for problem in found[1] if problem.severity is Severity.ERROR]
    assert problem.span is not None
    line = tree.parts[3].read_text().splitlines()[problem.span.line - 1]
    assert line[problem.span.column - 1 :].startswith("defualt")


_SLIPS = {
    "idle": "    forgotten = ExecuteProcess(cmd=['true'])\n",
    "foreign": "    written = '$(var rate)'\n",
    "roots": "    path = PathJoinSubstitution([rate, '/maps'])\n",
}


def test_what_looks_have_told_is_kept_with_the_code(tree: Tree, monkeypatch: pytest.MonkeyPatch) -> None:
    for part, slip in zip(tree.parts, _SLIPS.values(), strict=False):
        text = part.read_text().replace("    return", f"{slip}    return")
        part.write_text(text.replace("LaunchConfiguration\n", "LaunchConfiguration, PathJoinSubstitution\n"))
    first = tree.plan()
    assert all(f"part{number}.launch.py" in first for number in range(len(_SLIPS)))
    module._compiled.cache_clear()
    looked: list[str] = []
    for name, look in list(looks.LOOKS.items()):

        def noted(*given: Any, name: str = name, look: Any = look) -> bool:
            looked.append(name)
            return bool(look(*given))

        monkeypatch.setitem(looks.LOOKS, name, noted)
    assert tree.plan() == first
    assert not looked
    monkeypatch.setattr(module, "_LOOKING", ("compat/place.py",))
    monkeypatch.setattr(numbered, "TOLD", numbered.Told())
    assert tree.plan() == first
    assert set(looked) >= {*_SLIPS, "harmless"}


def test_files_that_are_alike_are_planned_as_if_each_were_compiled(
    tree: Tree, monkeypatch: pytest.MonkeyPatch
) -> None:
    for number, part in enumerate(tree.parts):
        tree.write(part, "long_" * number)
        part.write_text(part.read_text().replace('"true"', f"'$(var {'l' * number}rate)'", 1))
    asked: list[str] = []

    def counted(path: str, source: bytes) -> Any:
        asked.append(path)
        return from_compiler(path, source)

    from_compiler = module._from_compiler
    monkeypatch.setattr(module, "_from_compiler", counted)
    module._compiled.cache_clear()
    formed = tree.plan(keeping=False)
    assert formed.count('"severity": "warning"') == _FILES
    assert len(asked) < _FILES
    module._compiled.cache_clear()
    monkeypatch.setattr(forms.FORMS, "compiled", lambda _path, _source: None)
    monkeypatch.setattr(numbered, "TOLD", numbered.Told())
    assert tree.plan(keeping=False) == formed


def test_codes_are_nowhere_without_a_folder(tmp_path: Path) -> None:
    codes = Codes(None, str(tmp_path / "a.launch.py"))
    space: dict[str, Any] = {}
    exec(codes.code("a.launch.py", b"answer = 42\n" + b"#" * 100_000).code, space)  # noqa: S102 - code of ours
    assert space["answer"] == 42
    assert not codes.are_to_be_kept
    codes.keep()

"""Arguments of a launch file and of what it includes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from orchestra.cli.glance.walk import declared
from orchestra.resolve.packages import InstalledPackages

if TYPE_CHECKING:
    from pathlib import Path


def _seen(path: Path) -> list[tuple[str, str, bool]]:
    found = declared(str(path), InstalledPackages({}))
    return [(item.argument.name, item.file.rpartition("/")[2], item.conditional) for item in found]


def _write(folder: Path, **files: str) -> None:
    for name, text in files.items():
        (folder / f"{name}.launch.yaml").write_text(f"launch:\n{text}")


def test_includes_are_followed_where_they_are(tmp_path: Path) -> None:
    _write(
        tmp_path,
        a="  - arg: {name: one}\n  - include: {file: b.launch.yaml}\n  - arg: {name: last}\n",
        b="  - arg: {name: two}\n  - include: {file: c.launch.xml, if: x}\n",
    )
    (tmp_path / "c.launch.xml").write_text("<launch><arg name='three'/><arg name='one'/></launch>")
    assert _seen(tmp_path / "a.launch.yaml") == [
        ("one", "a.launch.yaml", False),
        ("last", "a.launch.yaml", False),
        ("two", "b.launch.yaml", False),
        ("three", "c.launch.xml", True),
    ]


def test_what_an_include_gives_nobody_else_can_give(tmp_path: Path) -> None:
    _write(
        tmp_path,
        a="  - include: {file: b.launch.yaml, arg: [{name: x, value: 1}]}\n",
        b="  - arg: {name: x}\n  - arg: {name: y}\n  - include: {file: c.launch.yaml}\n",
        c="  - arg: {name: x}\n  - arg: {name: z}\n",
    )
    assert [name for name, _, _ in _seen(tmp_path / "a.launch.yaml")] == ["y", "z"]


def test_the_declaration_that_always_counts_is_told(tmp_path: Path) -> None:
    _write(
        tmp_path,
        a="  - include: {file: b.launch.yaml, if: x}\n  - include: {file: c.launch.yaml}\n",
        b="  - arg: {name: x}\n",
        c="  - arg: {name: x}\n",
    )
    assert _seen(tmp_path / "a.launch.yaml") == [("x", "c.launch.yaml", False)]


def test_files_that_include_each_other_come_to_an_end(tmp_path: Path) -> None:
    _write(
        tmp_path,
        a="  - arg: {name: one}\n  - include: {file: b.launch.yaml}\n",
        b="  - arg: {name: two}\n  - include: {file: a.launch.yaml, arg: [{name: three, value: x}]}\n",
    )
    assert [name for name, _, _ in _seen(tmp_path / "a.launch.yaml")] == ["one", "two"]


def test_a_tree_that_grows_without_end_is_cut(tmp_path: Path) -> None:
    for number in range(20):
        includes = "".join(
            f"  - include: {{file: f{number + 1}.launch.yaml, arg: [{{name: n{number}{side}, value: x}}]}}\n"
            for side in "ab"
        )
        _write(tmp_path, **{f"f{number}": f"  - arg: {{name: here{number}}}\n{includes}"})
    assert ("here19", "f19.launch.yaml", False) in _seen(tmp_path / "f0.launch.yaml")


def test_what_is_not_there_is_left_out(tmp_path: Path) -> None:
    _write(tmp_path, a="  - arg: {name: one}\n  - include: {file: nowhere.launch.yaml}\n")
    assert _seen(tmp_path / "a.launch.yaml") == [("one", "a.launch.yaml", False)]
    assert _seen(tmp_path / "nowhere.launch.yaml") == []

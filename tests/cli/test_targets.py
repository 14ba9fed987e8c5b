"""Which files are looked at, and what each is taken for."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from orchestra.cli.targets import Target, kind_of, targets
from orchestra.errors import UsageError

if TYPE_CHECKING:
    from pathlib import Path

_PARAMETERS = "/talker:\n  ros__parameters:\n    rate: 1\n"


@pytest.mark.parametrize(
    ("name", "text", "kind"),
    [
        ("a.launch", "", "launch"),
        ("a.launch.xml", "", "launch"),
        ("a.launch.py", "", "launch"),
        ("a.launch.yaml", _PARAMETERS, "launch"),  # the name decides
        ("a.launch.yml", "", "launch"),
        ("a.launch.md", "launch:", None),
        ("launch.py", "", None),
        (".launch", "", None),
        ("a.yaml", "launch:\n- arg:\n", "launch"),
        ("a.yaml", "# hello\n\n'launch' : []\n", "launch"),
        ("a.yml", '{"launch": []}', "launch"),
        ("a.yaml", "launch:\n  - nod: [\n", "launch"),  # a syntax error hides nothing
        ("a.yaml", "x:\n  launch: 1\n", None),
        ("a.yaml", "relaunch: 1\n", None),
        ("a.yaml", "# launch: x\n", None),
        ("a.yaml", _PARAMETERS, "parameters"),
        ("a.yaml", "{/**: {ros__parameters: {a: 1}}}", "parameters"),
        ("a.yaml", "# ros__parameters: x\n", None),
        ("a.yaml", "", None),
        ("a.json", '{"launch": []}', None),
        ("a.py", "launch: int", None),
    ],
)
def test_kind(name: str, text: str, kind: str | None) -> None:
    assert kind_of(name, text) == kind


@pytest.fixture
def tree(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name, text in {
        "b/x.launch.py": "",
        "b/params.yaml": _PARAMETERS,
        "a.yaml": "launch: []\n",
        "notes.txt": "launch:\n",
        ".hidden/y.launch.py": "",
        "other.yaml": "x: 1\n",
    }.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.usefixtures("tree")
def test_a_folder_is_walked_in_order() -> None:
    assert targets(["."]) == (
        Target("a.yaml", "launch"),
        Target("b/params.yaml", "parameters"),
        Target("b/x.launch.py", "launch"),
    )


@pytest.mark.usefixtures("tree")
def test_each_file_counts_once() -> None:
    assert [target.path for target in targets(["b/params.yaml", "b", "./b"])] == [
        "b/params.yaml",
        "b/x.launch.py",
    ]


@pytest.mark.usefixtures("tree")
def test_a_named_file_is_a_launch_file_unless_it_has_parameters() -> None:
    assert targets(["other.yaml", "b/params.yaml"]) == (
        Target("other.yaml", "launch"),
        Target("b/params.yaml", "parameters"),
    )


def test_what_cannot_be_read_is_left_for_the_check_to_say(tree: Path) -> None:
    (tree / "c.yaml").symlink_to("nowhere")
    assert "c.yaml" not in [target.path for target in targets(["."])]
    (tree / "c.launch.yaml").symlink_to("nowhere")
    assert Target("c.launch.yaml", "launch") in targets(["."])


@pytest.mark.parametrize("path", ["nowhere", "empty"])
def test_nothing_to_look_at_is_a_mistake(tree: Path, path: str) -> None:
    (tree / "empty").mkdir()
    with pytest.raises(UsageError, match=path):
        targets([".", path])


@pytest.mark.parametrize(
    ("name", "text", "kind"),
    [
        ("config/talker.yaml", "talker:\n  rate: 10\n", "parameters"),
        ("talker_params.yaml", "talker:\n  rate: 10\n", "parameters"),
        ("config/robot.yaml", "launches:\n- node: {}\n", "launch"),
        ("config/robot.yaml", "- node: {}\n", "launch"),
        ("maps/arena.yaml", "image: arena.pgm\n", "launch"),
    ],
)
def test_a_file_that_is_named_may_lack_the_mark(tmp_path: Path, name: str, text: str, kind: str) -> None:
    """One of parameters is told from a launch file by where it is, and in a folder neither is looked at."""
    path = tmp_path / name
    path.parent.mkdir(exist_ok=True)
    path.write_text(text, "utf-8")
    (found,) = targets([str(path)])
    assert found.kind == kind
    with pytest.raises(UsageError, match="no parameter file"):
        targets([str(tmp_path)])

"""Launch files are found by path, by package and name, and by short names; what is meant by none is explained."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

import pytest

from orchestra.errors import UsageError
from orchestra.resolve.launch_files import find_launch_file, is_launch_file, launch_files, short_name
from orchestra.resolve.packages import InstalledPackages

if TYPE_CHECKING:
    from pathlib import Path

_MARKED = {".py": "def generate_launch_description():\n", ".xml": "<launch>", ".yaml": "launch: []\n"}
_SHARE = {
    "package.xml": "<package/>",
    "launch/bringup_launch.py": "",
    "launch/talk.launch.xml": "",
    "launch/both.launch.py": "",
    "launch/both.launch.yaml": "",
    "launch/old.launch": "",
    "launch/plain.xml": _MARKED[".xml"],
    "launch/helper.py": "import os\n",
    "launch/twice.launch.py": "",
    "more/twice.launch.py": "",
    "more/deep/talk.yaml": _MARKED[".yaml"],
    "config/plain.yaml": "a: 1\n",
    ".hidden/secret.launch.py": "",
}


@pytest.fixture
def share(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The share folder of a package `robot`; the working directory is empty but for `here.launch.py`."""
    index = tmp_path / "prefix" / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "robot").write_text("")
    folder = tmp_path / "prefix" / "share" / "robot"
    for name, text in _SHARE.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    here = tmp_path / "here"
    here.mkdir()
    (here / "here.launch.py").write_text("")
    monkeypatch.chdir(here)
    return folder


def _find(share: Path, *words: str) -> tuple[str, tuple[str, ...]]:
    packages = InstalledPackages({"AMENT_PREFIX_PATH": str(share.parents[1])})
    path, rest = find_launch_file(words, packages)
    return os.path.relpath(path, share), rest


@pytest.mark.conforms("5.2 package and file", "5.2 a file")
@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("robot bringup_launch.py", "launch/bringup_launch.py"),
        ("robot launch/bringup_launch.py", "launch/bringup_launch.py"),
        ("robot more/twice.launch.py", "more/twice.launch.py"),
        ("robot talk.yaml", "more/deep/talk.yaml"),
        ("robot plain.yaml", "config/plain.yaml"),  # an exact name is taken as it is, as upstream
        ("robot bringup", "launch/bringup_launch.py"),
        ("robot old", "launch/old.launch"),
        ("robot plain", "launch/plain.xml"),  # the one that is a launch file
        ("robot talk", "launch/talk.launch.xml"),  # the one that is called so
        ("robot deep/talk", "more/deep/talk.yaml"),
        ("robot more/twice", "more/twice.launch.py"),
        ("robot/bringup", "launch/bringup_launch.py"),
        ("robot/bringup_launch.py", "launch/bringup_launch.py"),
        ("robot/launch/twice", "launch/twice.launch.py"),
    ],
)
def test_what_a_name_means(share: Path, words: str, expected: str) -> None:
    assert _find(share, *words.split(), "a:=b", "c") == (expected, ("a:=b", "c"))


@pytest.mark.conforms("5.2 a file")
@pytest.mark.parametrize("word", ["here.launch.py", "./here.launch.py", "../here/here.launch.py"])
def test_a_file_that_is_there_wins(share: Path, word: str) -> None:
    assert _find(share, word, "robot") == ("../../../here/here.launch.py", ("robot",))


@pytest.mark.conforms("5.2 a file")
def test_a_file_called_like_a_package_wins(share: Path) -> None:
    (share.parents[2] / "here" / "robot").write_text("")
    assert _find(share, "robot", "bringup") == ("../../../here/robot", ("bringup",))


@pytest.mark.conforms("5.2 package and file", "5.2 unknown package")
@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("robot twice.launch.py", "the package 'robot' has more than one twice.launch.py: "
         "launch/twice.launch.py, more/twice.launch.py"),
        ("robot both", "the package 'robot' has more than one both: launch/both.launch.py, launch/both.launch.yaml"),
        ("robot/both", "more than one launch file is robot/both: launch/both.launch.py, launch/both.launch.yaml"),
        ("robot bringpu", "the package 'robot' has no launch file bringpu: did you mean 'bringup'?"),
        ("robot bringup_lanch.py", "has no launch file bringup_lanch.py: did you mean 'bringup_launch.py'?"),
        ("robot/bringpu", "there is no launch file robot/bringpu, nor has the package 'robot' one: "
         "did you mean 'bringup'?"),
        ("robot helper", "the package 'robot' has no launch file helper"),
        ("robot package", "the package 'robot' has no launch file package"),
        ("robot secret.launch.py", "the package 'robot' has no launch file secret.launch.py"),
        ("robto bringup", "there is no package 'robto': did you mean 'robot'?"),
        ("robto/bringup", "there is no launch file robto/bringup"),
        ("heer.launch.py", "there is no launch file heer.launch.py: did you mean here.launch.py?"),
        ("heer.launch.py bringup", "there is no launch file heer.launch.py: did you mean here.launch.py?"),
        ("./heer.launch.py a:=b", "there is no launch file ./heer.launch.py: did you mean here.launch.py?"),
        ("a:=b here.launch.py", "the launch file comes before its arguments, 'a:=b' is one"),
        (".", ". is there, but it is no file"),
        ("nothing", "there is no launch file nothing"),
    ],
)  # fmt: skip
def test_what_is_meant_by_nothing_is_explained(share: Path, words: str, message: str) -> None:
    with pytest.raises(UsageError) as raised:
        _find(share, *words.split())
    assert message in str(raised.value)


@pytest.mark.conforms("5.2 no file")
@pytest.mark.parametrize("words", [("robot",), ("robot", "a:=b")])
def test_a_package_alone_is_answered_with_its_launch_files(share: Path, words: tuple[str, ...]) -> None:
    with pytest.raises(UsageError) as raised:
        _find(share, *words)
    assert str(raised.value) == (
        "which launch file of the package 'robot'? it has both.launch.py, both.launch.yaml, bringup_launch.py, "
        "old.launch, plain.xml, talk.launch.xml, twice.launch.py, talk.yaml"
    )


def test_a_package_without_launch_files_says_so(share: Path) -> None:
    for path in launch_files(share):
        path.unlink()
    with pytest.raises(UsageError, match="it has none"):
        _find(share, "robot")


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("a.launch", "", True),
        ("a.launch.py", "", True),
        ("a_launch.py", "", True),
        ("a-launch.yml", "", True),
        ("a.launch.md", "", False),
        ("launch.py", "", False),
        (".launch.py", "", False),
        ("a.py", _MARKED[".py"], True),
        ("a.py", "async def generate_launch_description(x):\n", True),
        ("a.py", "generate_launch_description()\n", False),
        ("a.py", f"TEXT = '''\n{_MARKED['.py']}\n'''\n", False),  # a program that writes launch files
        ("a.py", f"try:\n    import x\nexcept ImportError:\n    {_MARKED['.py'].strip()} pass\n", True),
        ("a.py", f"class A:\n    {_MARKED['.py'].strip()} pass\n", False),
        ("a.xml", "<?xml version='1.0'?>\n<!-- x -->\n<launch version='0.1.1'>", True),
        ("a.xml", "<launchpad/>", False),
        ("a.yaml", "%YAML 1.2\n---\nlaunch:\n", True),
        ("a.yml", '{"launch": []}', True),
        ("a.yaml", "a: launch\n", False),
        ("a.yaml", "x" * (1 << 16) + "\nlaunch:\n", False),  # too far away to be looked for
        ("a.txt", "<launch>", False),
    ],
)
def test_what_plainly_is_a_launch_file(tmp_path: Path, name: str, text: str, expected: bool) -> None:
    (tmp_path / name).write_text(text)
    assert is_launch_file(tmp_path / name) is expected


def test_what_cannot_be_read_is_none_unless_it_is_called_one(tmp_path: Path) -> None:
    for name in ("a.yaml", "a.launch.yaml"):
        (tmp_path / name).symlink_to("nowhere")
    assert list(launch_files(tmp_path)) == [tmp_path / "a.launch.yaml"]


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("bringup.launch.py", "bringup"),
        ("bringup_launch.xml", "bringup"),
        ("bringup.launch", "bringup"),
        ("bringup.yaml", "bringup"),
        ("tb3.x.launch.yml", "tb3.x"),
        ("launch.py", "launch"),
    ],
)
def test_short_names(name: str, expected: str) -> None:
    assert short_name(name) == expected

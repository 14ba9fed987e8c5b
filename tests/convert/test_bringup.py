"""The bringup and the project's other launch files say the same in every language, there and back."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.convert.converting import convert
from orchestra.errors import Problems
from orchestra.formatting.formatted import formatted
from orchestra.pipeline import collect, inputs_from
from tests.convert.turning import others, round_trip, same_everywhere, seen, turned

if TYPE_CHECKING:
    from collections.abc import Mapping

_ROOT = Path(__file__).parents[2]
_ORDINARY = _ROOT / "tests" / "data" / "ordinary"
_ENVIRONMENT: Mapping[str, str] = {"PATH": "/usr/bin:/bin"}
_BRINGUP = {"two_robots.yaml": (), "robot.yaml": ("namespace:=robot1",)}
# Files that include others; as many words as make all that is in them count.
_VARIANTS = {
    "one_robot.yaml": (),
    "lifecycle.yaml": ("mode:=hold",),
    "container.yaml": (),
    "fleet.yaml": ("robots:=a,b", "site:=warehouse"),
    "fleet_robot.yaml": ("namespace:=robot1", "claim_service:=/claim"),
    "real_robot.yaml": ("scan:=lidar/scan", "cmd_vel:=base/cmd_vel"),
}


def _bringup(folder: Path) -> Path:
    """Return a copy of the bringup's launch files and what they read."""
    for name in ("params", "worlds", "robots"):
        shutil.copytree(_ROOT / "bringup" / name, folder / name)
    for path in (_ROOT / "bringup").glob("*.yaml"):
        shutil.copy(path, folder / path.name)
    return folder


@pytest.mark.parametrize("name", _BRINGUP)
def test_the_bringup_says_the_same_everywhere(name: str, tmp_path: Path) -> None:
    path = _bringup(tmp_path) / name
    assert not seen(path, _ENVIRONMENT, _BRINGUP[name]).errors
    same_everywhere(path, _ENVIRONMENT, _BRINGUP[name])
    round_trip(path, _ENVIRONMENT, _BRINGUP[name], rounds=2)


@pytest.mark.parametrize("name", _VARIANTS)
def test_other_ways_to_bring_it_up_say_the_same_there_and_back(name: str, tmp_path: Path) -> None:
    path = _bringup(tmp_path) / name
    assert not seen(path, _ENVIRONMENT, _VARIANTS[name]).errors
    round_trip(path, _ENVIRONMENT, _VARIANTS[name])


def test_the_whole_bringup_in_python_starts_the_same(tmp_path: Path) -> None:
    """Both files are converted, and the one includes the other in its new language."""
    folder = _bringup(tmp_path)
    plan = seen(folder / "two_robots.yaml", _ENVIRONMENT)
    for language in ("python", "xml"):
        robot = turned(folder / "robot.yaml", language, _ENVIRONMENT, "robot")
        both = turned(folder / "two_robots.yaml", language, _ENVIRONMENT, "both")
        text = both.read_text("utf-8")
        assert "robot.yaml" in text
        both.write_text(text.replace("robot.yaml", robot.name), "utf-8")
        converted = seen(both, _ENVIRONMENT)
        assert converted == plan


@pytest.mark.parametrize(
    "file", sorted(str(path.relative_to(_ORDINARY)) for path in _ORDINARY.glob("**/*.launch.*"))
)
def test_an_ordinary_file_says_the_same_everywhere(file: str, tmp_path: Path) -> None:
    shutil.copytree(_ORDINARY, tmp_path / "ordinary")
    round_trip(tmp_path / "ordinary" / file, _ENVIRONMENT)


def test_what_is_written_by_hand_for_two_robots_says_the_same_everywhere(tmp_path: Path) -> None:
    path = Path(shutil.copy(_ROOT / "tests" / "data" / "two_robots_by_hand.yaml", tmp_path))
    same_everywhere(path, _ENVIRONMENT)


def test_python_is_laid_out_as_its_formatters_do(tmp_path: Path) -> None:
    """`ruff format` lays out code as black does."""
    paths = [_ROOT / "bringup" / name for name in _BRINGUP]
    paths += sorted(_ORDINARY.glob("**/*.launch.yaml"))
    for index, path in enumerate(paths):
        found = convert(str(path), "python", _ENVIRONMENT)
        assert found.text is not None, found.remarks
        (tmp_path / f"f{index}.py").write_text(found.text, "utf-8")
    for words in (("format", "--diff"), ("check", "--select", "E,F,I,W,C4,PIE,Q", "--ignore", "E501")):
        ruff = [sys.executable, "-m", "ruff", *words, "--isolated", "--line-length", "88", str(tmp_path)]
        done = subprocess.run(ruff, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("language", ["xml", "yaml"])
def test_what_is_written_has_the_form_that_formatting_gives(language: str, tmp_path: Path) -> None:
    for name in _BRINGUP:
        path = _ROOT / "bringup" / name
        if language == "yaml":
            text = convert(str(path), "python", _ENVIRONMENT).text or ""
            path = tmp_path / f"{path.stem}.launch.py"
            path.write_text(text, "utf-8")
        found = convert(str(path), language, _ENVIRONMENT)
        assert found.text is not None
        written = found.text.encode()
        assert formatted(written, f"a.launch.{language}", lambda _: "launch", Problems()) == written


def test_every_language_is_written(tmp_path: Path) -> None:
    assert others(tmp_path / "a.launch.yaml") == ["xml", "python"]


def test_a_path_in_a_package_is_told_as_it_was(tmp_path: Path) -> None:
    """In defaults, and in the name of what a condition leaves out, which is never evaluated."""
    path, name = tmp_path / "a.launch.yaml", "$(find-pkg-share bringup)/worlds/$(var w)/a b.yaml"
    told = ["$(find-pkg-share bringup)/worlds/a b.yaml", "$(dirname)/maps/", name]
    arguments = "".join(f"  - arg: {{name: a{index}, default: {text}}}\n" for index, text in enumerate(told))
    left_out = "  - include: {if: false, file: $(find-pkg-share gone)/launch/a.yaml}\n"
    path.write_text(f"launch:\n  - arg: {{name: w, default: maze}}\n{arguments}{left_out}")
    for file in (path, turned(path, "python", _ENVIRONMENT)):
        plan = collect(str(file), inputs_from((), environment=_ENVIRONMENT), Problems())
        assert plan is not None
        assert [item.default for item in plan.arguments] == ["maze", *told]
        assert [item.name for item in plan.skipped] == ["$(find-pkg-share gone)/launch/a.yaml"]

"""What was probably meant, and what is only a slip of the keys."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

import orchestra.nearest
from orchestra.nearest import is_one_slip, is_slip, nearest, one_slip, renew
from orchestra.pipeline import check, inputs_from

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize(
    ("word", "candidates", "meant"),
    [
        ("outptu", ["output", "on_exit"], "output"),
        ("launch-prefx", ["launch_prefix"], "launch_prefix"),
        ("World", ["world", "word"], "world"),
        ("same", ["same", "sane"], "sane"),
        ("colour", ["name", "value"], None),
        ("scale_linear", ["scale_angular", "linear_scale"], "linear_scale"),
        ("", ["a"], None),
        ("a", [], None),
    ],
)
def test_the_nearest_word(word: str, candidates: list[str], meant: str | None) -> None:
    assert nearest(word, candidates) == meant
    assert nearest(word, reversed(candidates)) == meant


@pytest.mark.parametrize(
    ("word", "meant", "slip"),
    [
        ("exce", "exec", True),
        ("wrold", "world", True),
        ("defualt", "default", True),
        ("robot_name", "robot_sdf", False),
        ("remappings", "remap", False),
        ("robot1", "robot2", False),
        ("params_file", "slam_params_file", False),
    ],
)
def test_a_slip_of_the_keys(word: str, meant: str, slip: bool) -> None:
    assert is_slip(word, meant) is slip


@pytest.mark.parametrize(
    ("word", "meant", "slip"),
    [
        ("ymal", "yaml", True),
        ("numpi", "numpy", True),
        ("launchros", "launch_ros", True),
        ("launch-ros", "launch_ros", True),
        ("ament_index_pyton", "ament_index_python", True),
        ("subproces", "subprocess", True),
        ("sockets", "socket", False),
        ("selector", "selectors", False),
        ("scripts", "secrets", False),
        ("launch_pal", "launch_yaml", False),
        ("lxml", "xml", False),
        ("map", "mcap", False),
        ("tf2_msgs", "tf3_msgs", False),
        ("pose_x", "pose_y", False),
        ("port-b", "port_a", False),
        ("x_offset_m", "x_offset_n", False),
        ("pose_yaq", "pose_yaw", True),
    ],
)
def test_one_slip_of_the_keys(word: str, meant: str, slip: bool) -> None:
    assert is_one_slip(word, meant) is slip


def _misspelt(count: int) -> list[str]:
    return [f"argumnet_{number}" for number in range(count)]


def test_what_is_looked_for_in_one_file_has_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of each of a thousand words the like was looked for among a thousand others."""
    compared: list[tuple[str, str]] = []
    ratio = orchestra.nearest._ratio

    def counted(word: str, other: str) -> float:
        compared.append((word, other))
        return ratio(word, other)

    monkeypatch.setattr(orchestra.nearest, "_STEPS", 20_000)
    monkeypatch.setattr(orchestra.nearest, "_ratio", counted)
    renew()
    known = [f"argument_{number}" for number in range(100)]
    found = [nearest(word, known) for word in _misspelt(100)]
    assert found[:10] == known[:10]
    assert found[-10:] == [None] * 10
    before = len(compared)
    assert before < 20_000 / 16 + len(known)
    assert nearest("argumnet_7", iter(known)) is None
    assert one_slip("argumnet_7", known) is None
    assert len(compared) == before
    assert nearest("argumnet_7", known[:64]) == "argument_7"
    assert one_slip("argumnet_7", known[:64]) == "argument_7"
    renew()
    assert nearest("argumnet_7", known) == one_slip("argumnet_7", known) == "argument_7"
    monkeypatch.undo()
    renew()


def test_each_launch_file_has_its_own_end(tmp_path: Path) -> None:
    """What one file has used up is no other's."""
    orchestra.nearest._left[0] = 0
    lines = "".join(f"- let: {{name: argument_{number}, value: a}}\n" for number in range(70))
    path = tmp_path / "main.launch.yaml"
    path.write_text(f"launch:\n{lines}- log: {{message: $(var argumnet_7)}}\n")
    (problem,) = check(str(path), inputs_from([], environment={}))
    assert problem.suggestion == "argument_7"


def test_words_far_from_a_near_one_are_not_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    """What cannot be nearer than one that is known is not looked at letter by letter."""
    compared: list[tuple[str, str]] = []
    ratio = orchestra.nearest._ratio

    def counted(word: str, other: str) -> float:
        compared.append((word, other))
        return ratio(word, other)

    monkeypatch.setattr(orchestra.nearest, "_ratio", counted)
    renew()
    assert nearest(
        "velocity_contorller", [f"velocity_smoother_{n}" for n in range(60)] + ["velocity_controller"]
    )
    assert compared == []

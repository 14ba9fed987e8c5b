"""Pictures are files that other programs can open, with everything in them."""

import math
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from PIL import Image

from bringup.evaluation import pictures
from bringup.evaluation.drawing import consistency, trajectories
from bringup.evaluation.drawing.consistency import averaged
from bringup.evaluation.drawing.style import save, styled
from bringup.evaluation.drawing.trajectories import corners, ellipse
from bringup.evaluation.ground import facts, shapes
from bringup.evaluation.report import page
from bringup.evaluation.track import Track
from bringup.world.layout import lay_out
from bringup.world.shapes import Box

NAMES = ("trajectories", "errors", "consistency")


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory, track: Callable[..., Track]) -> Path:
    folder = tmp_path_factory.mktemp("drawn") / "new"
    told = facts(lay_out("arena", 1, ["robot1", "robot2"]))
    pictures.draw([track("robot1"), track("robot2", seed=1)], told, folder, ["A <note>."])
    return folder


def test_every_picture_is_there_twice_and_names_both_robots(drawn: Path) -> None:
    for name in NAMES:
        text = " ".join(ET.parse(drawn / f"{name}.svg").getroot().itertext())  # noqa: S314 - our own file
        assert "robot1" in text
        assert "robot2" in text
        with Image.open(drawn / f"{name}.png") as image:
            assert min(image.size) > 300
            assert len(image.convert("RGB").getcolors(10**6) or ()) > 10


def test_the_page_needs_no_other_file(drawn: Path) -> None:
    page = (drawn / "report.html").read_text(encoding="utf-8")
    assert page.count("<svg") == page.count("</svg>") == len(NAMES)
    assert page.count("<?xml") == page.count("<img") == page.count("<link") == page.count("<script") == 0
    assert "Evaluation of a run in arena, seed 1" in page
    assert "A &lt;note&gt;." in page
    assert page.count("<tr>") == 3


def test_the_same_run_gives_the_same_bytes(drawn: Path, tmp_path: Path, track: Callable[..., Track]) -> None:
    layout = lay_out("arena", 1, ["robot1", "robot2"])
    with styled():
        again = trajectories.draw(
            [track("robot1"), track("robot2", seed=1)], [*layout.walls, *layout.obstacles]
        )
        save(again, tmp_path, "trajectories")
    for name in ("trajectories.svg", "trajectories.png"):
        assert (drawn / name).read_bytes() == (tmp_path / name).read_bytes(), name


def test_a_run_without_map_and_innovations_can_be_drawn(track: Callable[..., Track]) -> None:
    bare = track(rows=50)
    bare.nis.clear()
    assert len(trajectories.draw([bare], []).axes) == 1
    assert len(consistency.draw([bare]).axes) == 1
    assert "<h1>Evaluation of a run</h1>" in page([bare], {}, {})


@pytest.mark.parametrize("angle", [0.0, 0.4, -1.2])
def test_an_ellipse_has_95_percent_of_the_errors_inside(angle: float) -> None:
    turn = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]])
    covariance = turn @ np.diag([0.09, 0.01]) @ turn.T
    width, height, turned = ellipse(covariance)
    assert (width, height) == pytest.approx((0.6 * math.sqrt(5.991), 0.2 * math.sqrt(5.991)), rel=1e-3)
    assert math.remainder(turned - angle, math.pi) == pytest.approx(0.0, abs=1e-9)


def test_corners_are_those_of_the_turned_box() -> None:
    found = corners(Box("b", 1.0, 2.0, 0.5, 0.2, math.pi / 2, 1.0))
    assert sorted(map(tuple, np.round(found, 9).tolist())) == [(0.8, 1.5), (0.8, 2.5), (1.2, 1.5), (1.2, 2.5)]


def test_innovations_are_averaged_over_windows() -> None:
    rows = np.array([(0.0, 1.0, 2.0), (0.4, 3.0, 2.0), (2.5, 7.0, 2.0)])
    times, means, counts = averaged(rows, window=1.0)
    assert (times.tolist(), means.tolist(), counts.tolist()) == ([0.5, 2.5], [2.0, 7.0], [2.0, 1.0])


def test_a_map_comes_back_as_it_was() -> None:
    layout = lay_out("arena", 7, ["robot1"])
    assert shapes(facts(layout)["shapes"]) == [*layout.walls, *layout.obstacles]

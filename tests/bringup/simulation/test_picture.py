"""The picture shows what the run has left: walls, obstacles and every path in its own colour."""

import math
from dataclasses import replace
from pathlib import Path

import pytest
from PIL import Image

from bringup.world import picture
from bringup.world.geometry import Pose
from bringup.world.layout import Layout, lay_out
from bringup.world.picture import Driven
from bringup.world.shapes import Cylinder

LAYOUT = replace(
    lay_out("arena", 1, ["robot1"], [Pose(-3.0, 0.0, 0.0)]), obstacles=(Cylinder("post", 0.0, 3.0, 0.4, 0.8),)
)


def drawn(tmp_path: Path, layout: Layout, *driven: Driven) -> "Image.Image":
    path = tmp_path / "run.png"
    picture.write(layout, driven, path)
    with Image.open(path) as image:
        assert image.format == "PNG"
        return image.convert("RGB")


def colour_at(image: "Image.Image", x: float, y: float) -> str:
    """The colour of a place of the world."""
    scale = picture.FIELD / 2 / 5.2
    column, row = picture.MARGIN + (x + 5.2) * scale, picture.MARGIN + (5.2 - y) * scale
    pixel = image.getpixel((int(column), int(row)))
    assert isinstance(pixel, tuple)
    return "#" + bytes(pixel).hex()


def line(y: float) -> list[tuple[float, float]]:
    return [(-3.0 + 0.05 * step, y) for step in range(100)]


def test_things_and_paths_are_where_they_belong(tmp_path: Path) -> None:
    image = drawn(tmp_path, LAYOUT, Driven("robot1", Pose(-3.0, 0.0, 0.0), line(0.0), line(1.0), line(-1.0)))
    blue = picture.COLOURS[0]
    assert colour_at(image, 0.0, 3.0) == picture.OBSTACLE
    assert colour_at(image, 5.1, 0.0) == picture.WALL
    assert colour_at(image, 2.5, -3.5) == picture.FLOOR
    assert colour_at(image, 0.5, 0.0) == picture._mixed(blue, 0.35)
    assert colour_at(image, 0.5, -1.0) == picture._dark(blue)
    assert picture._mixed(blue, 0.75) in {colour_at(image, 0.5 + 0.02 * step, 1.0) for step in range(10)}


@pytest.mark.parametrize("points", [[], [(0.0, 0.0)], [(0.0, 0.0), (1e300, -1e300)]])
def test_a_run_that_hardly_was_or_went_astray_is_drawn_too(
    tmp_path: Path, points: list[tuple[float, float]]
) -> None:
    drawn(tmp_path, LAYOUT, Driven("robot1", Pose(0.0, 0.0, math.pi), points, points, points))


@pytest.mark.parametrize("world", ["arena", "maze"])
def test_more_robots_than_colours(tmp_path: Path, world: str) -> None:
    layout = lay_out(world, 2, [f"r{number}" for number in range(8)])
    robots = [Driven(start.robot, start.pose, [], [], []) for start in layout.starts]
    image = drawn(tmp_path, layout, *robots)
    colours = image.getcolors(maxcolors=1 << 20)
    assert colours is not None
    assert len(colours) > len(picture.COLOURS)

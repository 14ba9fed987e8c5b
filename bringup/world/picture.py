"""The world from above with the paths the robots have driven, as a PNG file.

Everything is drawn at twice the size and scaled down, because Pillow draws lines without smoothing.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PIL import Image, ImageDraw, ImageFont

from bringup.world.body import FOOTPRINT_RADIUS
from bringup.world.geometry import Pose
from bringup.world.shapes import Box, Cylinder, Shape

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from bringup.world.layout import Layout

SMOOTHING = 2
FIELD = 900
MARGIN = 36
LINE = 26
LEGEND_WIDTH = 250
PAPER, FLOOR, GRID, WALL, OBSTACLE, INK = "#ffffff", "#f4f5f7", "#e1e4e8", "#4a4e57", "#b98a57", "#24292f"
COLOURS = ("#1f6fd0", "#d1432f", "#2a9148", "#8453b8", "#c98500", "#0c8f9c")

Points = list[tuple[float, float]]


@dataclass(frozen=True, slots=True)
class Driven:
    """One robot's start pose and paths, all in world coordinates."""

    robot: str
    start: Pose
    true: Points
    odometry: Points
    filtered: Points


@dataclass(frozen=True, slots=True)
class _Canvas:
    """A drawing surface in pixels, and how metres lie on it."""

    draw: ImageDraw.ImageDraw
    half: float

    def at(self, x: float, y: float) -> tuple[float, float]:
        # Far outside is far enough: Pillow cannot count without end.
        far = 10 * self.half
        x, y = max(-far, min(far, x)), max(-far, min(far, y))
        scale = FIELD * SMOOTHING / (2 * self.half)
        margin = MARGIN * SMOOTHING
        return margin + (x + self.half) * scale, margin + (self.half - y) * scale

    def metres(self, length: float) -> float:
        return length * FIELD * SMOOTHING / (2 * self.half)


def write(layout: Layout, driven: Sequence[Driven], path: Path) -> None:
    """Draw a run and write it as PNG. Raises OSError if the file cannot be written."""
    width, height = FIELD + 3 * MARGIN + LEGEND_WIDTH, FIELD + 2 * MARGIN
    image = Image.new("RGB", (width * SMOOTHING, height * SMOOTHING), PAPER)
    # The outer walls' thickness belongs to the picture.
    canvas = _Canvas(ImageDraw.Draw(image), layout.half + 0.2)
    _ground(canvas, layout)
    for number, robot in enumerate(driven):
        _paths(canvas, robot, COLOURS[number % len(COLOURS)])
    for number, robot in enumerate(driven):
        _start(canvas, robot.start, COLOURS[number % len(COLOURS)])
    _legend(canvas.draw, layout, driven)
    image.resize((width, height), Image.Resampling.BOX).save(path, format="PNG")


def _ground(canvas: _Canvas, layout: Layout) -> None:
    low, high = canvas.at(-layout.half, layout.half), canvas.at(layout.half, -layout.half)
    canvas.draw.rectangle([low, high], fill=FLOOR)
    for metre in range(-math.floor(layout.half), math.floor(layout.half) + 1):
        canvas.draw.line(
            [canvas.at(metre, -layout.half), canvas.at(metre, layout.half)], fill=GRID, width=SMOOTHING
        )
        canvas.draw.line(
            [canvas.at(-layout.half, metre), canvas.at(layout.half, metre)], fill=GRID, width=SMOOTHING
        )
    for shape in (*layout.obstacles, *layout.walls):
        _shape(canvas, shape, WALL if shape.name.startswith("wall") else OBSTACLE)


def _shape(canvas: _Canvas, shape: Shape, colour: str) -> None:
    if isinstance(shape, Cylinder):
        canvas.draw.circle(canvas.at(shape.x, shape.y), canvas.metres(shape.radius), fill=colour)
    else:
        canvas.draw.polygon(_corners(canvas, shape), fill=colour)


def _corners(canvas: _Canvas, box: Box) -> Points:
    cos, sin = math.cos(box.yaw), math.sin(box.yaw)
    signs = ((1, 1), (-1, 1), (-1, -1), (1, -1))
    offsets = [(i * box.half_x, j * box.half_y) for i, j in signs]
    return [canvas.at(box.x + cos * x - sin * y, box.y + sin * x + cos * y) for x, y in offsets]


def _paths(canvas: _Canvas, robot: Driven, colour: str) -> None:
    """The truth as a pale broad band, on it the filter as a thin line; the odometry dotted, wherever it leads."""
    _line(canvas, robot.true, _mixed(colour, 0.35), width=9)
    _dots(canvas, robot.odometry, _mixed(colour, 0.75))
    _line(canvas, robot.filtered, _dark(colour), width=2)


def _line(canvas: _Canvas, points: Points, colour: str, width: int) -> None:
    if len(points) > 1:
        canvas.draw.line(
            [canvas.at(x, y) for x, y in points], fill=colour, width=width * SMOOTHING, joint="curve"
        )


def _dots(canvas: _Canvas, points: Points, colour: str) -> None:
    last = (math.inf, math.inf)
    for x, y in points:
        here = canvas.at(x, y)
        if math.dist(here, last) >= 8 * SMOOTHING:
            canvas.draw.circle(here, 2 * SMOOTHING, fill=colour)
            last = here


def _start(canvas: _Canvas, start: Pose, colour: str) -> None:
    """The robot's outline where it stood first, with a line to its front."""
    radius = canvas.metres(FOOTPRINT_RADIUS)
    centre = canvas.at(start.x, start.y)
    nose = centre[0] + radius * math.cos(start.yaw), centre[1] - radius * math.sin(start.yaw)
    canvas.draw.circle(centre, radius, fill=PAPER, outline=colour, width=3 * SMOOTHING)
    canvas.draw.line([centre, nose], fill=colour, width=3 * SMOOTHING)


def _legend(draw: ImageDraw.ImageDraw, layout: Layout, driven: Sequence[Driven]) -> None:
    font = ImageFont.load_default(15 * SMOOTHING)
    left, top = (FIELD + 2 * MARGIN) * SMOOTHING, MARGIN * SMOOTHING
    title = f"{layout.name}, seed {layout.seed}, {2 * layout.half:g} m wide"
    draw.rectangle([(left - MARGIN * SMOOTHING, 0), draw.im.size], fill=PAPER)
    draw.text((left, top), title, fill=INK, font=font)
    top += 2 * LINE * SMOOTHING
    for number, robot in enumerate(driven):
        colour = COLOURS[number % len(COLOURS)]
        draw.text((left, top), robot.robot, fill=colour, font=font)
        for row, kind in enumerate(("start", "true path", "filtered", "wheel odometry"), start=1):
            _sample(draw, kind, (left, top + row * LINE * SMOOTHING), colour, font)
        top += 6 * LINE * SMOOTHING


def _sample(
    draw: ImageDraw.ImageDraw,
    kind: str,
    at: tuple[float, float],
    colour: str,
    font: ImageFont.FreeTypeFont | ImageFont.ImageFont,
) -> None:
    long = 44 * SMOOTHING
    left, middle = at[0], at[1] + 9 * SMOOTHING
    ends = [(left, middle), (left + long, middle)]
    if kind == "start":
        draw.circle((left + long / 2, middle), 8 * SMOOTHING, fill=PAPER, outline=colour, width=2 * SMOOTHING)
    elif kind == "true path":
        draw.line(ends, fill=_mixed(colour, 0.35), width=9 * SMOOTHING)
    elif kind == "filtered":
        draw.line(ends, fill=_dark(colour), width=2 * SMOOTHING)
    else:
        for dot in range(0, long + 1, 8 * SMOOTHING):
            draw.circle((left + dot, middle), 2 * SMOOTHING, fill=_mixed(colour, 0.75))
    draw.text((left + long + 12 * SMOOTHING, at[1]), kind, fill=INK, font=font)


def _mixed(colour: str, share: float) -> str:
    """So much of the colour on white paper."""
    return _hex([round(255 - share * (255 - value)) for value in _channels(colour)])


def _dark(colour: str) -> str:
    return _hex([round(0.55 * value) for value in _channels(colour)])


def _channels(colour: str) -> bytes:
    return bytes.fromhex(colour.removeprefix("#"))


def _hex(channels: Sequence[int]) -> str:
    return "#" + bytes(channels).hex()

"""What a run is described and shown by: messages as bytes, the URDF, rendered images, recordings."""

from __future__ import annotations

import math
import os
import subprocess
import sys
import xml.etree.ElementTree as ET
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from nav_msgs.msg import Odometry
from PIL import Image
from rclpy.serialization import deserialize_message, serialize_message

from bringup.world import rendering
from bringup.world.body import CAMERAS, MOUNTS
from bringup.world.cameras import camera_info
from bringup.world.description import JOINTS, describe
from bringup.world.inertial import InertialNoise
from bringup.world.layout import WORLDS, lay_out
from bringup.world.messages import mounts, new_imu, new_odometry, new_scan, quaternion
from bringup.world.model import load
from bringup.world.recording import HEIGHT, RATE, WIDTH, RecordingError, opened, seen
from bringup.world.rendering import NoRenderingError, Renderer
from bringup.world.simulation import Simulation
from bringup.world.wire import offset

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


@pytest.mark.parametrize(
    ("message", "path", "kind", "value"),
    [
        (new_odometry("a"), "pose.pose.position.x", "d", 1.5),
        (new_odometry("a_longer_name"), "twist.covariance.7", "d", 0.25),
        (new_odometry("abc"), "header.stamp.nanosec", "I", 77),
        (new_imu("abcd", InertialNoise()), "linear_acceleration.z", "d", 9.81),
        (new_scan("ab"), "ranges.359", "f", 2.5),
        (new_scan("ab"), "scan_time", "f", 3.5),
    ],
)
def test_a_number_is_written_where_the_message_has_it(
    message: Any, path: str, kind: str, value: float
) -> None:
    size = {"d": "<f8", "f": "<f4", "I": "<u4"}[kind]
    at = offset(message, path, kind)
    written = bytearray(serialize_message(message))
    written[at : at + np.dtype(size).itemsize] = np.array([value], size).tobytes()
    *way, last = path.split(".")
    owner = message
    for name in way:
        owner = getattr(owner, name)
    if last.isdigit():
        owner[int(last)] = value
    else:
        setattr(owner, last, value)
    kind_of = type(message)
    assert deserialize_message(bytes(written), kind_of) == deserialize_message(
        serialize_message(message), kind_of
    )


def test_a_field_that_a_message_does_not_have_is_an_error() -> None:
    with pytest.raises(AttributeError):
        offset(Odometry(), "pose.place.x", "d")


def test_the_description_is_one_tree_with_the_weight_of_the_model() -> None:
    model = load(lay_out("arena", 1, ["one", "two"]))
    robot = ET.fromstring(describe(model, 1))  # noqa: S314 - our own
    assert robot.get("name") == "two"
    joints = {joint.find("child").get("link"): joint for joint in robot.findall("joint")}  # type: ignore[union-attr] # each has one
    links = [link.get("name") for link in robot.findall("link")]
    assert set(links) - set(joints) == {"two/base_footprint"}
    assert {f"two/{mount.child}" for mount in (*MOUNTS, *CAMERAS)} == set(joints)
    assert [joint.get("name") for joint in joints.values() if joint.get("type") == "continuous"] == [
        f"two/{joint}" for joint in JOINTS
    ]
    masses = [float(mass.get("value", "nan")) for mass in robot.iter("mass")]
    assert sum(masses) == pytest.approx(model.physics.body_mass.sum() / 2)
    for inertia in robot.iter("inertia"):
        xx, xy, xz, yy, yz, zz = (
            float(inertia.get(name, "nan")) for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
        )
        assert (np.linalg.eigvalsh([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) > 0.0).all()


def test_a_camera_looks_ahead_with_its_image_upright() -> None:
    """REP 103: in an optical frame z is forwards and x to the right."""
    x, y, z, w = quaternion(-math.pi / 2, 0.0, -math.pi / 2)
    turn = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    assert np.allclose(turn @ (0, 0, 1), (1, 0, 0))
    assert np.allclose(turn @ (1, 0, 0), (0, -1, 0))
    optical = mounts("a", CAMERAS)[1]
    assert optical.child_frame_id == "a/camera_optical_frame"
    assert optical.transform.rotation.w == pytest.approx(w)
    info = camera_info("a", 320, 240)
    assert 2 * math.atan(120 / info.k[4]) == pytest.approx(math.radians(60.0))


def test_where_nothing_can_be_rendered_it_is_said_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rendering, "LIBRARIES", {"egl": ("libNoSuchThing.so.1",)})
    monkeypatch.delenv("MUJOCO_GL", raising=False)
    with pytest.raises(NoRenderingError, match="there is no EGL and no OSMesa here; install") as refused:
        Renderer(load(lay_out("arena", 1, ["a"])), 64, 48)
    assert "\n" not in str(refused.value)


def test_a_library_that_does_not_work_is_told_with_its_reason() -> None:
    """In a process of its own: MuJoCo's GL modules are imported once."""
    code = (
        "from bringup.world.rendering import *\n"
        "from bringup.world.model import load\n"
        "from bringup.world.layout import lay_out\n"
        "try: Renderer(load(lay_out('arena', 1, ['a'])), 64, 48)\n"
        "except NoRenderingError as error: print(error)"
    )
    env = os.environ | {"MUJOCO_GL": "egl", "PYOPENGL_PLATFORM": "osmesa"}
    done = subprocess.run(
        [sys.executable, "-c", code], env=env, capture_output=True, text=True, timeout=60, check=True
    )
    assert done.stdout.startswith("nothing can be rendered with egl (")
    assert len(done.stdout.splitlines()) == 1


@pytest.fixture(scope="module")
def shown() -> Iterator[tuple[Simulation, Renderer]]:
    """A robot before a wall and what renders it."""
    simulation = Simulation(load(lay_out("maze", 2, ["a"])))
    try:
        renderer = Renderer(simulation.model, WIDTH, HEIGHT)
    except NoRenderingError as error:
        pytest.skip(str(error))
    yield simulation, renderer
    renderer.close()


def test_a_camera_sees_the_floor_below_and_what_stands_ahead(shown: tuple[Simulation, Renderer]) -> None:
    simulation, renderer = shown
    image = renderer.render(simulation.data, "a/camera", 160, 120)
    assert image.shape == (120, 160, 3)
    assert image[-1].min() > 150  # the pale floor
    assert image[:60].std() > 1.0


def test_a_film_has_a_picture_for_every_twentieth_of_a_second(
    shown: tuple[Simulation, Renderer], tmp_path: Path
) -> None:
    av = pytest.importorskip("av")
    simulation, renderer = shown
    recording, picture = opened(tmp_path / "run.mp4"), seen(renderer, simulation.data)
    for tick in range(1, 41):
        recording.add(tick, picture)
    recording.close(picture)
    with av.open(str(tmp_path / "run.mp4")) as film:
        stream = film.streams.video[0]
        frames = [frame.to_ndarray(format="rgb24") for frame in film.decode(stream)]
        assert stream.average_rate == RATE
    assert len(frames) == 8
    assert np.abs(frames[0].astype(int) - picture().astype(int)).mean() < 8.0


def test_a_picture_shows_the_end(shown: tuple[Simulation, Renderer], tmp_path: Path) -> None:
    simulation, renderer = shown
    recording = opened(tmp_path / "run.PNG")
    recording.add(5, lambda: pytest.fail("only the end is wanted"))
    recording.close(seen(renderer, simulation.data))
    with Image.open(tmp_path / "run.PNG") as image:
        assert image.size == (WIDTH, HEIGHT)


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("run.gif", "should end in .mp4 or .png"),
        ("none/run.mp4", "cannot be written"),
        ("none/run.png", "cannot be written"),
    ],
)
def test_a_recording_that_cannot_be_is_refused(tmp_path: Path, name: str, reason: str) -> None:
    with pytest.raises(RecordingError, match=reason):
        opened(tmp_path / name)


@pytest.mark.parametrize("world", WORLDS)
def test_every_world_is_in_the_picture(shown: tuple[Simulation, Renderer], world: str) -> None:
    """The four corners of the world are where the overview shows something."""
    assert shown
    model = load(lay_out(world, 3, ["a"]))
    camera = model.physics.camera("overview")
    place, axes = camera.pos, np.array(camera.mat0).reshape(3, 3)
    tangent = math.tan(math.radians(float(camera.fovy[0])) / 2)
    half = model.layout.half
    for x, y in ((half, half), (-half, half), (half, -half), (-half, -half)):
        right, up, back = axes.T @ (np.array([x, y, 0.0]) - place)
        assert abs(up / -back) < tangent
        assert abs(right / -back) < tangent * WIDTH / HEIGHT

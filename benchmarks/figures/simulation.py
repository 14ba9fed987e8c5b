"""The simulation of two robots, as fast as it goes: real seconds for a simulated one, alone and with both filters.

The floor is the same physics step by step, without sensors, messages or anything else. Filters are heard before the
world begins. The bars are 20 and 8 times real time: where the bare physics runs at 300 times, ratios of 15 and 37.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from benchmarks import launching
from benchmarks.figure import Figure, Sample, Site, UnableError
from orchestra.testing.domain import free_domain

if TYPE_CHECKING:
    from collections.abc import Mapping

_FLOOR_TITLE = "the bare physics of a simulated second"
FIGURES = (
    Figure(
        "simulation", "a simulated second of two robots, unthrottled", _FLOOR_TITLE,
        "ratio", 5.0, "s", 40, (10, 20, 40), 2,
    ),
    Figure(
        "simulation-filters", "the same with both filters", _FLOOR_TITLE,
        "ratio", 15.0, "s", 40, (10, 20, 40), 2,
    ),
)  # fmt: skip

_FLOOR = """
import sys, time
from bringup.world.layout import lay_out
from bringup.world.model import load
from bringup.world.physics import mujoco
physics = load(lay_out("arena", 1, ["robot1", "robot2"])).physics
data = mujoco.MjData(physics)
data.ctrl[:] = 3.0, 4.0, 4.0, 2.0
second = round(1 / physics.opt.timestep)
count = second * int(sys.argv[1])
mujoco.mj_step(physics, data, second)
began = time.perf_counter()
for _ in range(count):
    mujoco.mj_step(physics, data)
print((time.perf_counter() - began) / int(sys.argv[1]))
"""
_SCRIPT = "time,robot,linear,angular\n0.0,robot1,0.3,0.4\n0.0,robot2,0.3,-0.5\n"
_FILTER = """\
  - node:
      pkg: bringup
      exec: ekf
      name: ekf
      namespace: {robot}
      param:
        - {{from: $(find-pkg-share bringup)/params/ekf.yaml}}
        - {{name: use_sim_time, value: true}}
        - {{name: odom_frame, value: {robot}/odom}}
        - {{name: world_frame, value: {robot}/odom}}
        - {{name: base_link_frame, value: {robot}/base_footprint}}
      ready: {{service: set_pose}}
"""
_WORLD = """\
  - node:
      pkg: bringup
      exec: simulation
      name: simulation
      param:
        - {{name: speed, value: 0.0}}
        - {{name: duration, value: {duration}}}
        - {{name: script, value: {script}}}
      required: true
      depends_on: [{awaited}]
"""
_TOLD = re.compile(r"simulated (\d+\.\d+) s in (\d+\.\d+) s")


def measure(site: Site, size: int) -> Mapping[str, Sample]:
    """Measure it over so many simulated seconds."""
    try:
        import mujoco  # noqa: F401, PLC0415 - only whether it is there
        import rclpy  # noqa: F401, PLC0415 - as above
    except ImportError:
        raise UnableError("it needs rclpy and MuJoCo") from None
    samples = {}
    for name, robots in (("simulation", ()), ("simulation-filters", ("robot1", "robot2"))):
        floor = launching.printed(_FLOOR, [str(size)], site)
        with free_domain({}) as domain:
            variables = launching.with_variables(site.environment, ROS_DOMAIN_ID=str(domain))
            samples[name] = Sample(_seconds(Site(site.folder, variables), size, robots), floor)
    return samples


def _seconds(site: Site, size: int, robots: tuple[str, ...]) -> float:
    """Return the real seconds of a simulated one, as the simulation tells it at its end."""
    script, file = site.folder / "drive.csv", site.folder / "world.launch.yaml"
    script.write_text(_SCRIPT)
    awaited = ", ".join(f"{{node: /{robot}/ekf, condition: ready}}" for robot in robots)
    world = _WORLD.format(duration=float(size), script=script, awaited=awaited)
    file.write_text("launch:\n" + "".join(_FILTER.format(robot=robot) for robot in robots) + world)
    launching.wall(launching.orchestra("launch", file), site)
    told = _TOLD.search((launching.run_directory(site) / "logs" / "simulation.log").read_text())
    if told is None or float(told[1]) != size:
        raise RuntimeError(f"the simulation has not come to its end: {told}")
    return float(told[2]) / size

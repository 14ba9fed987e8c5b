"""The two robots, started by hand with the script of their plan."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.testing.domain import free_domain

if TYPE_CHECKING:
    from collections.abc import Iterator

_ROOT = Path(__file__).parents[3]
_STARTED = "run directory: "


@pytest.fixture
def environment(tmp_path: Path) -> Iterator[dict[str, str]]:
    with free_domain(os.environ) as domain:
        yield {**os.environ, "ROS_DOMAIN_ID": str(domain), "TMPDIR": str(tmp_path)}


def test_the_two_robots_drive_from_a_script(tmp_path: Path, environment: dict[str, str]) -> None:
    """They find each other, take their parameters, use simulated time, and end with the simulation."""
    script = tmp_path / "two_robots.sh"
    words = ("bringup/two_robots.yaml", "duration:=2", "--format", "sh")
    made = subprocess.run(
        [sys.executable, "-m", "orchestra", "plan", *words],
        cwd=_ROOT,
        env=environment,
        capture_output=True,
        timeout=60,
        check=True,
    )
    script.write_bytes(made.stdout)
    # Without what this interpreter has been given when it was started: the script brings its own.
    own = {
        name: value
        for name, value in environment.items()
        if name not in ("LD_LIBRARY_PATH", "AMENT_PREFIX_PATH")
    }
    done = subprocess.run(
        ["bash", str(script)], cwd=_ROOT, env=own, capture_output=True, text=True, timeout=100, check=False
    )
    assert done.returncode == 0, done.stderr
    run = Path(done.stderr.partition(_STARTED)[2].partition("\n")[0])
    assert "simulated 2.00 s" in done.stdout + done.stderr
    assert (run / "logs" / "two_robots.png").stat().st_size > 1000
    assert "filter error" in done.stdout + done.stderr

"""Starts what is measured, and what it is measured against."""

from __future__ import annotations

import compileall
import contextlib
import importlib.util
import json
import os
import select
import signal
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from benchmarks import costs

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from benchmarks.figure import Site

# Whoever has not got so far by then never will, in seconds.
PATIENCE: Final = 300.0
# As long as a launcher gives a process to end by itself, in seconds.
_GRACE: Final = 5.0

_UPSTREAM: Final = """
import sys
from launch import LaunchDescription, LaunchService
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import AnyLaunchDescriptionSource
service = LaunchService(noninteractive=True)
service.include_launch_description(
    LaunchDescription([IncludeLaunchDescription(AnyLaunchDescriptionSource(sys.argv[1]))])
)
sys.exit(service.run())
"""


def compile_all() -> None:
    """Have the bytecode of our modules on the disk, as an installation has."""
    compileall.compile_dir(Path(__file__).parent.parent / "orchestra", quiet=1)


def orchestra(*words: str | Path) -> list[str]:
    """Return a command line of Orchestra's."""
    return [sys.executable, "-m", "orchestra", *map(str, words)]


def upstream(file: Path) -> list[str] | None:
    """Return the command line by which ROS 2's own launch launches a file; None where it is not installed."""
    packages = ("launch", "launch_ros", "launch_xml", "launch_yaml")
    if any(importlib.util.find_spec(package) is None for package in packages):
        return None
    return [sys.executable, "-c", _UPSTREAM, str(file)]


def environment(folder: Path) -> dict[str, str]:
    """Return the environment of what is started: no run, cache or setting of the user's own."""
    kept = {name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"}
    return {
        **kept,
        "PYTHONPATH": os.pathsep.join((str(Path(__file__).parent.parent), str(folder))),
        "ORCHESTRA_HOME": str(folder / "home"),
        "ORCHESTRA_CACHE": str(folder / "cache"),
        "XDG_CACHE_HOME": str(folder / "caches"),
        "XDG_RUNTIME_DIR": str(folder),
        "ROS_LOG_DIR": str(folder / "ros"),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }


@contextmanager
def started(
    command: Sequence[str], site: Site, stdout: int | None = subprocess.DEVNULL, *, may_hang: bool = False
) -> Iterator[subprocess.Popen[bytes]]:
    """Run a command in a session of its own; all of it is ended where it has not ended by itself.

    Raises `RuntimeError` where it then has failed. What `may_hang` has not failed when it was killed by `end`.
    """
    errors = site.folder / "errors"
    with (
        errors.open("ab") as stderr,
        subprocess.Popen(
            command,
            cwd=site.folder,
            env=dict(site.environment),
            stdin=subprocess.DEVNULL,
            stdout=stdout,
            stderr=stderr,
            start_new_session=True,
        ) as popen,
    ):
        try:
            yield popen
        except BaseException:
            # What a shell has started in sessions of their own would stay.
            for process in costs.tree(popen.pid):
                with contextlib.suppress(ProcessLookupError):
                    os.kill(process.pid, signal.SIGTERM)
            print(errors.read_text()[-2000:], file=sys.stderr)
            raise
        finally:
            status = finished(popen)
    well = (0, 128 + signal.SIGINT, 128 + signal.SIGTERM, -signal.SIGINT, -signal.SIGTERM)
    if status not in well and not (may_hang and status == -signal.SIGKILL):
        raise RuntimeError(f"{command} ended with {status}: {errors.read_text()[-2000:]}")


def finished(popen: subprocess.Popen[bytes]) -> int:
    """Wait for the end of a command, which is due; return its status."""
    try:
        return popen.wait(PATIENCE)
    except subprocess.TimeoutExpired:
        os.killpg(popen.pid, signal.SIGKILL)
        raise


def wall(command: Sequence[str], site: Site, stdout: int | None = subprocess.DEVNULL) -> float:
    """Return the seconds from the start of a command to its end."""
    began = time.perf_counter()
    with started(command, site, stdout) as popen:
        finished(popen)
        return time.perf_counter() - began


def printed(program: str, arguments: Sequence[str | Path], site: Site) -> float:
    """Return the number that a program in Python prints last."""
    done = subprocess.run(
        [sys.executable, "-c", program, *map(str, arguments)],
        cwd=site.folder,
        env=dict(site.environment),
        check=False,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )
    if done.returncode:
        raise RuntimeError(done.stderr[-2000:])
    return float(done.stdout.split()[-1])


def run_directory(site: Site) -> Path:
    """Return the directory of the latest run."""
    return max((site.folder / "home" / "runs").iterdir(), key=lambda path: path.stat().st_mtime_ns)


def events(site: Site) -> list[dict[str, Any]]:
    """Return what happened in the latest run."""
    return [json.loads(line) for line in (run_directory(site) / "events.jsonl").read_text().splitlines()]


def moments(site: Site, kind: str) -> list[float]:
    """Return when something happened in the latest run, in seconds of the monotonic clock."""
    return [event["monotonic"] for event in events(site) if event["kind"] == kind]


def until(there: Callable[[], bool], pause: float = 0.0005) -> float:
    """Wait until something is so, looking every `pause` seconds; return when it was seen."""
    deadline = time.perf_counter() + PATIENCE
    while not there():
        if time.perf_counter() > deadline:
            raise TimeoutError(there)
        time.sleep(pause)
    return time.perf_counter()


def with_variables(site_environment: Mapping[str, str], **variables: str | Path) -> dict[str, str]:
    """Return an environment with some more variables."""
    return {**site_environment, **{name: str(value) for name, value in variables.items()}}


def end(pids: Sequence[int]) -> None:
    """End processes that nobody else ends: a node that hangs when it is told to is killed, as a launcher would do."""
    with ExitStack() as opened:
        waiting = {}
        for pid in pids:
            descriptor = os.pidfd_open(pid)
            opened.callback(os.close, descriptor)
            waiting[descriptor] = pid
            signal.pidfd_send_signal(descriptor, signal.SIGTERM)
        deadline = time.monotonic() + _GRACE
        while waiting and (left := deadline - time.monotonic()) > 0:
            for descriptor in select.select(list(waiting), [], [], left)[0]:
                del waiting[descriptor]
        for descriptor in waiting:
            signal.pidfd_send_signal(descriptor, signal.SIGKILL)

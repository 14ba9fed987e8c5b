"""Answers lack nothing, however busy the machine is: a hundred times each, in a graph of twenty nodes of three kinds.

python -m pytest -m long -s tests/ros/tools/test_whole_answers.py
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from orchestra.testing.domain import free_domain

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [pytest.mark.long, pytest.mark.timeout(3600)]

_PROCESSES = Path(__file__).parents[2] / "processes"
_PROGRAM = _PROCESSES / "one_of_many.py"
_PLAIN, _WARM, _COMPONENTS = 10, 6, 3  # and the container itself
_TRIALS = 100
_WITHIN = 120.0
_LAUNCH = """
launch:
{nodes}
- node_container:
    pkg: rclcpp_components
    exec: component_container
    name: box
    namespace: ""
    composable_node:
{components}
"""


def _launch_file() -> str:
    nodes = (
        f"- node: {{script: {_PROGRAM}, args: warm{number} {number}, name: warm{number}}}"
        for number in range(_WARM)
    )
    components = (
        f'    - {{pkg: demo, plugin: "one_of_many:Idle", name: part{number}}}'
        for number in range(_COMPONENTS)
    )
    return _LAUNCH.format(nodes="\n".join(nodes), components="\n".join(components))


@contextmanager
def _ended(process: subprocess.Popen[bytes]) -> Iterator[None]:
    try:
        yield
    finally:
        process.terminate()
        process.wait()


@pytest.fixture(scope="module")
def crowd(tmp_path_factory: pytest.TempPathFactory) -> Iterator[dict[str, str]]:
    """Twenty nodes, and the environment in which they are."""
    pytest.importorskip("rclpy", reason="needs ROS")
    folder = tmp_path_factory.mktemp("crowd")
    (folder / "crowd.launch.yaml").write_text(_launch_file(), "utf-8")
    with ExitStack() as stack:
        domain = stack.enter_context(free_domain({}))
        environment = {
            **os.environ,
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ORCHESTRA_HOME": str(folder),
            "PYTHONPATH": str(_PROCESSES),
        }
        commands = [[str(_PROGRAM), f"plain{number}", str(number)] for number in range(_PLAIN)]
        # Last, as `run` below.
        commands.append(["-m", "orchestra", "launch", str(folder / "crowd.launch.yaml")])
        for words in commands:
            process = subprocess.Popen(
                [sys.executable, *words],
                env=environment,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
            stack.enter_context(_ended(process))
        run = process
        until = time.monotonic() + _WITHIN
        while (told := _asked(environment, "node", "list")) != _NODES:
            assert time.monotonic() < until, told
            assert run.poll() is None, "the launch has ended"
        yield environment


_NODES = "".join(
    f"/{name}\n"
    for name in sorted(
        [f"plain{number}" for number in range(_PLAIN)]
        + [f"warm{number}" for number in range(_WARM)]
        + [f"part{number}" for number in range(_COMPONENTS)]
        + ["box"]
    )
)
_TOPICS = "".join(
    f"{name}\n"
    for name in sorted(
        [f"{node}/said" for node in _NODES.split() if node != "/box"] + ["/parameter_events", "/rosout"]
    )
)


def _asked(environment: dict[str, str], *words: str) -> str:
    done = subprocess.run(
        [sys.executable, "-m", "orchestra", *words],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=_WITHIN,
    )
    return done.stdout or done.stderr


@contextmanager
def _load() -> Iterator[None]:
    """Have twice as many processes compute as there are processors."""
    with ExitStack() as stack:
        for _ in range(2 * (os.cpu_count() or 1)):
            busy = subprocess.Popen([sys.executable, "-c", "while True: pass"])
            stack.enter_context(_ended(busy))
        yield


@pytest.mark.parametrize("loaded", [False, True], ids=["as-it-is", "under-load"])
@pytest.mark.parametrize(
    ("words", "answer"),
    [
        (("node", "list"), _NODES),
        (("topic", "list"), _TOPICS),
        (("param", "get", "/plain7", "number"), "Integer value is: 7\n"),
        (("param", "get", "/part1", "number"), "Integer value is: 0\n"),
    ],
    ids=["node-list", "topic-list", "param-get", "param-get-of-a-component"],
)
def test_nothing_is_missing_in_a_hundred_answers(
    crowd: dict[str, str], words: tuple[str, ...], answer: str, *, loaded: bool
) -> None:
    wrong, took = [], []
    with ExitStack() as stack:
        if loaded:
            stack.enter_context(_load())
        for _ in range(_TRIALS):
            began = time.perf_counter()
            told = _asked(crowd, *words)
            took.append(time.perf_counter() - began)
            if told != answer:
                wrong.append(told)
    print(f"{' '.join(words)}: median {statistics.median(took):.3f} s, longest {max(took):.3f} s")  # noqa: T201 - for -s
    assert not wrong, f"{len(wrong)} of {_TRIALS}: {wrong[0]}"

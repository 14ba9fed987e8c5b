"""The simulation node as a child process, and a real subscriber that listens to it."""

from __future__ import annotations

import os
import queue
import signal
import subprocess
import sys
import threading
import warnings
from collections import defaultdict
from collections.abc import Callable
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.task import Future

if TYPE_CHECKING:
    from collections.abc import Iterator


Start = Callable[..., AbstractContextManager["Run"]]


@dataclass
class Run:
    """A started simulation: what it has said, line by line, and its process."""

    process: subprocess.Popen[str]
    lines: list[str] = field(default_factory=list)
    _fresh: queue.Queue[str | None] = field(default_factory=queue.Queue)
    reader: threading.Thread = field(init=False)

    def __post_init__(self) -> None:
        self.reader = threading.Thread(target=self._read)
        self.reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self._fresh.put(line)
        self._fresh.put(None)

    def wait_for(self, text: str, deadline: float = 60.0) -> str:
        """The first new line that holds the text; fails if the node ends or the deadline passes before."""
        while (line := self._fresh.get(timeout=deadline)) is not None:
            self.lines.append(line)
            if text in line:
                return line
        pytest.fail(f"the node ended without saying '{text}': {''.join(self.lines)}")

    def end(self, deadline: float = 60.0) -> tuple[int, str]:
        """The exit status and all that was said, once the node has ended."""
        status = self.process.wait(deadline)
        while (line := self._fresh.get(timeout=deadline)) is not None:
            self.lines.append(line)
        return status, "".join(self.lines)


@contextmanager
def simulation(domain: int, *arguments: str, **environment: str) -> Iterator[Run]:
    """The node with these ROS arguments, killed at the end if it still runs."""
    env = os.environ | {
        "ROS_DOMAIN_ID": str(domain),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "AMENT_PREFIX_PATH": sys.prefix,
        **environment,
    }
    command = [sys.executable, "-m", "bringup.nodes.simulation", "--ros-args", *arguments]
    with subprocess.Popen(
        command, env=env, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    ) as process:
        run = Run(process)
        try:
            yield run
        finally:
            if process.poll() is None:
                process.send_signal(signal.SIGKILL)
            process.wait()
            run.reader.join()


@dataclass
class Ears:
    """A node of the test that keeps every message it hears, by topic, spinning in a thread of its own."""

    node: Node
    heard: dict[str, list[Any]] = field(default_factory=lambda: defaultdict(list))

    fresh: threading.Condition = field(default_factory=threading.Condition)

    def listen(self, message: type, topic: str, qos: QoSProfile | None = None) -> None:
        def hear(message: Any) -> None:
            with self.fresh:
                self.heard[topic].append(message)
                self.fresh.notify_all()

        self.node.create_subscription(message, topic, hear, qos or QoSProfile(depth=1000))

    def wait(self, topic: str, looked_for: Callable[[list[Any]], Any], deadline: float = 60.0) -> Any:
        """What is looked for among the messages of a topic, as soon as it is there: the last one of a list."""
        with self.fresh:
            assert self.fresh.wait_for(lambda: looked_for(self.heard[topic]), deadline), f"nothing of {topic}"
            found = looked_for(self.heard[topic])
        return found[-1] if isinstance(found, list) else found


@contextmanager
def ears(domain: int) -> Iterator[Ears]:
    context = Context()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        rclpy.init(context=context, domain_id=domain)
    executor = SingleThreadedExecutor(context=context)
    with warnings.catch_warnings():
        # The first node of a process imports lark, which imports a module that Python deprecates.
        warnings.simplefilter("ignore", DeprecationWarning)
        node = rclpy.create_node("ears", context=context)
    executor.add_node(node)
    over: Future[None] = Future()
    thread = threading.Thread(target=executor.spin_until_future_complete, args=(over,))
    thread.start()
    try:
        yield Ears(node)
    finally:
        # An executor that is shut down while it waits fails now and then: what it waits on is destroyed.
        over.set_result(None)
        thread.join()
        executor.shutdown()
        node.destroy_node()
        context.shutdown()


@pytest.fixture(scope="session")
def start() -> Start:
    """Start the node: `with start(domain, *ros_arguments, **environment) as run`."""
    return simulation


@pytest.fixture(scope="session")
def listen() -> Callable[[int], AbstractContextManager[Ears]]:
    """Listen on a graph: `with listen(domain) as ears`."""
    return ears

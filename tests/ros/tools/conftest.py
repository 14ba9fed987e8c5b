"""Nodes that run in a domain of their own, and the commands that ask them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import pytest

from orchestra.testing.domain import free_domain
from tests.killing import kill

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

# Which commands wait for a minute, for somebody new and for an answer: on a busy machine either may take long, and what is
# whole, or answered, is waited for no longer.
_PATIENT = {
    "--spin-time": {"action", "graph", "lifecycle", "node", "param", "service", "tf", "topic"},
    "--timeout": {"lifecycle", "param"},
}
_PROGRAM = Path(__file__).parents[2] / "processes" / "talked_with.py"


class Done(NamedTuple):
    """How a command has ended."""

    status: int
    output: str
    errors: str

    @property
    def data(self) -> Any:
        """What it has written as JSON."""
        assert self.status == 0, self.errors
        return json.loads(self.output)


class Graph:
    """The nodes of one domain, and a shell beside them."""

    def __init__(self, environment: dict[str, str]) -> None:
        self.environment = environment

    def ask(self, *words: str, given: str = "") -> Done:
        """Carry a command out."""
        done = subprocess.run(
            self.command(*words),
            env=self.environment,
            input=given,
            capture_output=True,
            text=True,
            check=False,
            timeout=100,
        )
        return Done(done.returncode, done.stdout, done.stderr)

    def told(self, *words: str) -> str:
        """Return what a command writes that goes well."""
        done = self.ask(*words)
        assert done.status == 0, done.errors
        return done.output

    @contextmanager
    def asking(self, *words: str) -> Iterator[subprocess.Popen[str]]:
        """Have a command that does not end by itself."""
        with subprocess.Popen(
            self.command(*words),
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        ) as process:
            try:
                yield process
            finally:
                kill(process)

    def in_time(self, is_right: Callable[[Done], bool], *words: str) -> Done:
        """Ask for what is to come in one second (`SECONDS` among the words), then in more: a busy machine takes longer."""
        for seconds in ("1", "5", "25"):
            done = self.ask(*(seconds if word == "SECONDS" else word for word in words))
            if is_right(done):
                break
        return done

    @staticmethod
    def command(*words: str) -> list[str]:
        """Return the words of a command line."""
        patient = [
            word
            for option, commands in _PATIENT.items()
            if words[0] in commands and option not in words
            for word in (option, "60")
        ]
        return [sys.executable, "-m", "orchestra", *words, *patient]


@pytest.fixture(scope="session")
def domain() -> Iterator[dict[str, str]]:
    """An environment with a domain in which nobody else is."""
    pytest.importorskip("rclpy", reason="needs ROS")
    with free_domain({}) as number:
        yield {
            **os.environ,
            "ROS_DOMAIN_ID": str(number),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "NO_COLOR": "1",
        }


class Nodes:
    """The nodes of `tests/processes/talked_with.py`. Where their process has ended another one follows."""

    def __init__(self, domain: dict[str, str]) -> None:
        self._domain = domain
        self._process: subprocess.Popen[str] | None = None

    def start(self) -> None:
        """See that they are there."""
        if self._process is not None and self._process.poll() is None:
            return
        self.close()
        self._process = subprocess.Popen(
            [sys.executable, str(_PROGRAM)], env=self._domain, stdout=subprocess.PIPE, text=True
        )
        assert self._process.stdout is not None
        assert "ready\n" in self._process.stdout  # the middleware may say something before

    def close(self) -> None:
        """End them."""
        if self._process is not None:
            kill(self._process)
            assert self._process.stdout is not None
            self._process.stdout.close()
            self._process = None


@pytest.fixture(scope="session")
def nodes(domain: dict[str, str]) -> Iterator[Nodes]:
    """The nodes of a session."""
    found = Nodes(domain)
    yield found
    found.close()


@pytest.fixture
def graph(nodes: Nodes, domain: dict[str, str]) -> Graph:
    """A graph with those nodes."""
    nodes.start()
    return Graph(domain)

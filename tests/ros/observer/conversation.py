"""Observers without a supervisor, and nodes for them to look at."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import threading
from typing import TYPE_CHECKING, Any, NamedTuple

from orchestra.supervise.graph.discovery import quick_discovery
from tests.killing import kill
from tests.supervise.plans import PROCESSES, wait_for

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path


class Spoken:
    """A process that is told lines and answers with lines."""

    def __init__(self, popen: subprocess.Popen[str]) -> None:
        self.popen = popen
        self.lines: list[str] = []
        threading.Thread(target=self._read, daemon=True).start()

    def tell(self, line: str) -> None:
        assert self.popen.stdin
        self.popen.stdin.write(line + "\n")
        self.popen.stdin.flush()

    def _read(self) -> None:
        assert self.popen.stdout
        for line in self.popen.stdout:
            self.lines.append(line.rstrip("\n"))


class Node(Spoken):
    """`tests/processes/graph_node.py`."""

    def do(self, *lines: str) -> None:
        """Have it done, all of it."""
        assert self.popen.poll() is None
        before = len(self.lines)
        for line in lines:
            self.tell(line)
        wait_for(lambda: self.lines[before:] == [*lines], f"{lines}")


class Conversation(Spoken):
    """An observer."""

    def ask(self, identity: str, do: str, /, **facts: Any) -> None:
        self.tell(json.dumps({"id": identity, "do": do, **facts}))

    def watch(self, identity: str, fact: str, /, **about: Any) -> None:
        self.ask(identity, "watch", fact=fact, **about)

    def forget(self, name: str) -> None:
        self.tell(json.dumps({"forget": name}))

    def heard(self, name: str) -> list[dict[str, Any]]:
        """What has been said to an order so far."""
        messages = [json.loads(line) for line in [*self.lines]]
        return [message for message in messages if message.get("id") == name]

    def said(self, name: str, word: str) -> dict[str, Any]:
        """Wait for a word to an order."""

        def found() -> list[dict[str, Any]]:
            return [message for message in self.heard(name) if message["say"] == word]

        message: dict[str, Any] = wait_for(found, f"{word} to {name}; {self.heard(name)}")[-1]
        return message

    def caught_up(self) -> None:
        """Wait until all that was told before has been taken up."""
        pong = json.dumps({"pong": len(self.lines)})
        self.tell(json.dumps({"ping": len(self.lines)}))
        wait_for(lambda: pong in self.lines, pong)


class Domain(NamedTuple):
    """A ROS domain, and a folder for the profile that makes discovery quick, as in a run."""

    number: int
    folder: Path

    @property
    def environment(self) -> dict[str, str]:
        """The environment of processes in it."""
        reach = {"ROS_DOMAIN_ID": str(self.number), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        return {**os.environ, **quick_discovery(os.environ, self.folder), **reach}


@contextlib.contextmanager
def observing(domain: Domain) -> Iterator[Conversation]:
    """Start an observer."""
    with _piped(domain, "-m", "orchestra.ros.observer", str(os.getpid())) as popen:
        yield Conversation(popen)


@contextlib.contextmanager
def graph_node(domain: Domain, name: str) -> Iterator[Node]:
    """Start a node that knows its own graph."""
    with _piped(domain, str(PROCESSES / "graph_node.py"), name) as popen:
        node = Node(popen)
        wait_for(lambda: node.lines or popen.poll(), f"{name} to be up")
        yield node


@contextlib.contextmanager
def _piped(domain: Domain, *words: str) -> Iterator[subprocess.Popen[str]]:
    pipe = subprocess.PIPE
    with subprocess.Popen(
        [sys.executable, *words], stdin=pipe, stdout=pipe, text=True, env=domain.environment
    ) as popen:
        try:
            yield popen
        finally:
            kill(popen)

"""What every readiness condition can do."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True, slots=True)
class Request:
    """What the observer is to look for in the ROS graph: the first message on a topic."""

    topic: str


class Probe(Protocol):
    """A readiness condition, for one run of a process."""

    @property
    def words(self) -> str:
        """What is awaited, for messages: "a line that matches 'listening'"."""

    @property
    def request(self) -> Request | None:
        """What the observer is to look for; its answer is the readiness. None where none is needed."""

    def read(self, stream: str, text: str) -> bool:
        """Take a piece of the process's output; tell whether the condition holds now."""

"""Ready when the first message has come on a topic."""

from __future__ import annotations

from orchestra.probes.protocol import Request


class MessageProbe:
    """Asks the observer for the first message on a fully qualified topic."""

    def __init__(self, topic: str) -> None:
        self.request = Request(topic)

    @property
    def words(self) -> str:
        """What is awaited."""
        return f"a message on {self.request.topic}"

    def read(self, _stream: str, _text: str) -> bool:
        """Output says nothing about messages."""
        return False

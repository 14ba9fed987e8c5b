"""A client of a language server: as much of the protocol as an editor needs to complete, explain and mark.

Source: Language Server Protocol 3.17.
"""

from __future__ import annotations

import json
import subprocess
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import IO, TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from pathlib import Path

_SETTINGS = {"validate": True, "hover": True, "completion": True, "yamlVersion": "1.2", "schemas": {}}


@dataclass(slots=True)
class LanguageServer:
    """A server that is asked for one thing after the other."""

    to: IO[bytes]
    from_: IO[bytes]
    asked: int = 0
    marks: dict[str, list[dict[str, Any]]] = field(default_factory=dict)

    def open(self, file: Path, text: str) -> list[dict[str, Any]]:
        """Open a text as a file; return what is marked in it."""
        uri = file.as_uri()
        document = {"uri": uri, "languageId": "yaml", "version": 1, "text": text}
        self.tell("textDocument/didOpen", {"textDocument": document})
        while uri not in self.marks:
            self.receive()
        return self.marks[uri]

    def at(self, what: str, file: Path, line: int, column: int) -> Any:
        """Ask for something about a place, counted from 0."""
        place = {"line": line, "character": column}
        return self.ask(f"textDocument/{what}", {"textDocument": {"uri": file.as_uri()}, "position": place})

    def ask(self, method: str, parameters: Any) -> Any:
        """Return the answer to a request."""
        self.asked += 1
        self.send({"id": self.asked, "method": method, "params": parameters})
        while True:
            message = self.receive()
            if message.get("id") == self.asked and "method" not in message:
                return message["result"]

    def tell(self, method: str, parameters: Any) -> None:
        """Send a message that has no answer."""
        self.send({"method": method, "params": parameters})

    def send(self, message: dict[str, Any]) -> None:
        """Send a message."""
        content = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.to.write(b"Content-Length: %d\r\n\r\n%b" % (len(content), content))
        self.to.flush()

    def receive(self) -> dict[str, Any]:
        """Return the next message; what the server asks is answered, what it marks is noted."""
        length = 0
        while line := self.from_.readline().strip():
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
        assert length, "the language server has ended"
        message: dict[str, Any] = json.loads(self.from_.read(length))
        if message.get("method") == "textDocument/publishDiagnostics":
            self.marks[message["params"]["uri"]] = message["params"]["diagnostics"]
        elif "method" in message and "id" in message:
            self.send({"id": message["id"], "result": _answer(message)})
        return message


@contextmanager
def language_server(command: Sequence[str]) -> Iterator[LanguageServer]:
    """Run a language server that speaks on its standard streams."""
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
    )
    assert process.stdin is not None
    assert process.stdout is not None
    with process, process.stdin, process.stdout:
        server = LanguageServer(process.stdin, process.stdout)
        snippets = {"completionItem": {"snippetSupport": True, "documentationFormat": ["markdown"]}}
        document = {"completion": snippets, "hover": {"contentFormat": ["markdown"]}}
        able = {"textDocument": document, "workspace": {"configuration": True}}
        server.ask("initialize", {"processId": None, "rootUri": None, "capabilities": able})
        server.tell("initialized", {})
        try:
            yield server
        finally:
            process.kill()


def _answer(message: dict[str, Any]) -> Any:
    if message["method"] != "workspace/configuration":
        return None
    return [_SETTINGS if item.get("section") == "yaml" else None for item in message["params"]["items"]]

"""A run that an operator asks for things, as a client of the control socket would.

operated.py DOCUMENT FIFO    each line of FIFO is a request: `stop a b`, `start a`, `restart a`, `signal USR1 a`, `down why`

What is answered is appended, as a line of JSON, to FIFO.said.
"""

import json
import os
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

from orchestra.supervise.run import run

if TYPE_CHECKING:
    from orchestra.supervise.operation import Operation
    from orchestra.supervise.surroundings import Surroundings


class Operator:
    def __init__(self, around: "Surroundings", operation: "Operation") -> None:
        self.around = around
        self.operation = operation
        self.descriptor = os.open(sys.argv[2], os.O_RDWR | os.O_NONBLOCK)
        around.loop.on_readable(self.descriptor, self.read)

    def read(self) -> None:
        for line in os.read(self.descriptor, 65536).decode().splitlines():
            what, *words = line.split()
            with Path(f"{sys.argv[2]}.said").open("a") as said:
                said.write(json.dumps(self.ask(what, words)) + "\n")

    def ask(self, what: str, words: list[str]) -> object:
        if what == "down":
            self.operation.down(" ".join(words))
            return None
        if what == "signal":
            return self.operation.signal(words[1:], signal.Signals[f"SIG{words[0]}"])
        if what == "ps":
            return [(one.id, one.phase, one.starts, one.awaited) for one in self.operation.processes()]
        answer: object = getattr(self.operation, what)(words)
        return answer

    def close(self) -> None:
        self.around.loop.forget(self.descriptor)
        os.close(self.descriptor)


def prepare(stream: BinaryIO) -> int:
    stream.write(Path(sys.argv[1]).read_bytes())
    return 0


sys.exit(run(prepare, lambda around, operation, _run, _keeper: Operator(around, operation)))

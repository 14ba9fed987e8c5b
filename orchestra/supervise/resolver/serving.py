"""The resolver's side of the connection: hands the document over and answers questions, one JSON object per line."""

from __future__ import annotations

import contextlib
import json
import os
import sys
from typing import TYPE_CHECKING, Any

from orchestra.supervise.keeping.standard_streams import flush

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import TypeAlias

    # From one question to its answer, both JSON data; `orchestra.supervise.run.run` says which.
    Answer: TypeAlias = Callable[[dict[str, Any]], dict[str, Any]]


class Settled:
    """What `prepare` returns where it has succeeded, and `afterwards` is something for which nobody need wait."""

    __slots__ = ("afterwards",)

    def __init__(self, afterwards: Callable[[], None]) -> None:
        self.afterwards = afterwards


def hand_over(document: memoryview, descriptor: int, *, stays: bool, settled: bool) -> None:
    """Send the document.

    `stays` says that this process does not end yet, `settled` that it has nothing to do with the run any more.
    """
    header = json.dumps({"size": len(document), "stays": stays, "settled": settled}) + "\n"
    _send(descriptor, header.encode())
    _send(descriptor, document)


def serve(answer: Answer, descriptor: int) -> int:
    """Answer each question until there are no more, or nobody waits for the answer."""
    with (
        contextlib.suppress(BrokenPipeError, ConnectionResetError),
        os.fdopen(descriptor, "rb", closefd=False) as questions,
    ):
        for line in questions:
            reply = json.dumps(_answered(answer, json.loads(line)))
            flush()
            _send(descriptor, reply.encode() + b"\n")
    return 0


def _answered(answer: Answer, question: dict[str, Any]) -> dict[str, Any]:
    """Let the code of the description decide; whatever it raises is a failure of this one trigger."""
    try:
        return answer(question)
    except (Exception, SystemExit) as error:  # noqa: BLE001 - the boundary to the user's code
        import traceback  # noqa: PLC0415 - the resolver of every run imports this module

        traceback.print_exc(file=sys.stderr)
        return {"failure": f"{type(error).__name__}: {error}", "location": None}


def _send(descriptor: int, content: bytes | memoryview) -> None:
    data = memoryview(content)
    while data:
        data = data[os.write(descriptor, data) :]

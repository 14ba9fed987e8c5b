"""Makes plans, and remembers them, on request: one JSON line per question, one per answer.

A question has `do` (`make` or `recall`), `words`, `folder` and `environment`. Each is answered by a fork of this
process, which has imported everything. The answer has the `document` (null where nothing is remembered), what was
`told`, whether the plan was `kept`, and `why` it could not be.
"""

from __future__ import annotations

import io
import json
import os
import sys
from typing import Any

import orchestra.cli.handover
import orchestra.cli.launch
import orchestra.cli.recollection
import orchestra.cli.remembering
import orchestra.pipeline  # noqa: F401
from orchestra.cli.main import prepare
from orchestra.cli.remembered import remembered
from orchestra.supervise.resolver.serving import Settled
from orchestra.witness.observing import observer


def main() -> None:
    """Answer until there are no more questions."""
    for line in sys.stdin:
        reading, writing = os.pipe()
        if not os.fork():
            try:
                with os.fdopen(writing, "w") as answer:
                    json.dump(_answer(json.loads(line)), answer)
            finally:
                os._exit(0)
        os.close(writing)
        with os.fdopen(reading) as answered:
            sys.stdout.write((answered.read() or "null") + "\n")
        sys.stdout.flush()
        os.wait()


def _answer(question: dict[str, Any]) -> dict[str, Any]:
    os.chdir(question["folder"])
    os.environ.clear()
    os.environ.update(question["environment"])
    if question["do"] == "recall":
        found = remembered(question["words"])
        return (
            {"document": None} if found is None else {"document": found.document.decode(), "told": found.told}
        )
    stream, told, before = io.BytesIO(), io.StringIO(), sys.stderr
    sys.stderr = told
    try:
        result = prepare(question["words"], stream)
    finally:
        sys.stderr = before
    if isinstance(result, Settled):
        result.afterwards()
    record = observer().record
    return {
        "document": stream.getvalue().decode() or None,
        "told": told.getvalue(),
        "kept": isinstance(result, Settled),
        "why": None if record is None else record.unknown,
    }


if __name__ == "__main__":
    main()

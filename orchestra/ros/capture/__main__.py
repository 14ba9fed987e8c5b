"""The process that asks one node: the question is the one argument, the answer one line on standard output."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

# Where this is not installed but run from its sources.
sys.path.append(str(Path(__file__).parents[3]))


def main() -> int:
    """Ask the node, and say what it answers."""
    question = json.loads(sys.argv[1])
    # Libraries may print: the answer goes to a descriptor of its own.
    answers = os.dup(1)
    os.dup2(2, 1)
    from orchestra.ros.capture.asking import answer  # noqa: PLC0415 - rclpy, which may print when it is imported

    told = answer(question["node"], float(question["timeout"]), interfaces=bool(question["interfaces"]))
    with os.fdopen(answers, "w", encoding="utf-8") as stream:
        stream.write(json.dumps(told) + "\n")
    return 0


if __name__ == "__main__":
    status = main()
    sys.stderr.flush()
    os._exit(status)

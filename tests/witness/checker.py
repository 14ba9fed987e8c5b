"""Checks folders on request: one JSON line per question, one per answer.

A question has the `folder`, the `environment`, and whether the `cache` counts. An answer has the problems as data, and
how many files were known.
"""

from __future__ import annotations

import json
import os
import sys

from orchestra.cli.checking import Manner, check
from orchestra.cli.look.finding import Finding
from orchestra.cli.targets import targets
from orchestra.pipeline import inputs_from


def main() -> None:
    """Answer until there are no more questions."""
    for line in sys.stdin:
        question = json.loads(line)
        os.chdir(question["folder"])
        os.environ.clear()
        os.environ.update(question["environment"])
        manner = Manner(jobs=2, cache=question["cache"])
        checked = check(targets(["."]), inputs_from([], environment=os.environ), manner)
        answer = {"problems": Finding("", checked.problems).as_data()["problems"], "known": checked.unchanged}
        sys.__stdout__.write(json.dumps(answer) + "\n")  # type: ignore[union-attr] # there is one
        sys.__stdout__.flush()  # type: ignore[union-attr] # as above


if __name__ == "__main__":
    main()

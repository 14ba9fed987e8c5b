"""Problems as a JSON list; `schemas/problem.schema.json` describes it."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from orchestra.plan.codec import encode_problem

if TYPE_CHECKING:
    from collections.abc import Sequence

    from orchestra.cli.colour import Paint
    from orchestra.cli.problems.sources import Sources
    from orchestra.errors import Problem


def render(problems: Sequence[Problem], _sources: Sources, _paint: Paint) -> str:
    """Return the problems as one JSON list."""
    return json.dumps([encode_problem(problem) for problem in problems], indent=2, ensure_ascii=False) + "\n"

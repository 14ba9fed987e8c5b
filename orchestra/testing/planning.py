"""Planning a description in a test: what would be started, without starting it."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from orchestra import pipeline
from orchestra.errors import DescriptionError
from orchestra.fields import replace
from orchestra.testing.launching import file_of

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from orchestra.plan.model import Plan
    from orchestra.testing.launching import Description


def planned(
    description: Description, *words: str, home: Path, environment: Mapping[str, str] | None = None
) -> Plan:
    """Return the plan of a description; `words` follow the file on the command line, `environment` is added.

    `home` is a folder for the file of a description that is given as content. Raises `DescriptionError`, with a note
    for each problem, where there are errors.
    """
    given = pipeline.inputs_from(words, environment={**os.environ, **(environment or {})})
    try:
        return pipeline.make_plan(file_of(description, home), replace(given, launching=False))
    except DescriptionError as error:
        for problem in error.problems:
            error.add_note(f"{problem.span or 'command line'}: {problem.severity}: {problem.message}")
        raise

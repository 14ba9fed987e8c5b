"""The pytest plug-in, which pytest finds by its entry point: the fixtures `launch` and `plan`.

Every test session of the environment loads this module, so it imports what the fixtures need when they are used.
"""

from __future__ import annotations

from contextlib import ExitStack
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping
    from pathlib import Path

    from orchestra.plan.model import Plan
    from orchestra.testing.launching import Description
    from orchestra.testing.run import Run


@pytest.fixture
def launch(tmp_path: Path) -> Iterator[Callable[..., Run]]:
    """Launch descriptions as `orchestra.testing.launched` does.

    `run = launch("robot.yaml", "world:=maze")`, or as a context manager, to end it earlier than at the end of the test.
    Each is stopped at the end of the test, the last one first, and has to have ended well with nothing left of it.
    """
    from orchestra.testing.launching import launched  # noqa: PLC0415

    with ExitStack() as stack:
        count = 0

        def start(description: Description, *words: str, environment: Mapping[str, str] | None = None) -> Run:
            nonlocal count
            count += 1
            home = tmp_path / f"orchestra-{count}"
            return stack.enter_context(launched(description, *words, home=home, environment=environment))

        yield start


@pytest.fixture
def plan(tmp_path: Path) -> Callable[..., Plan]:
    """Plan descriptions without starting anything: `plan("robot.yaml", "world:=maze").processes`.

    Raises `DescriptionError`, with a note for each problem, where there are errors.
    """
    from orchestra.testing.planning import planned  # noqa: PLC0415

    def make(description: Description, *words: str, environment: Mapping[str, str] | None = None) -> Plan:
        return planned(description, *words, home=tmp_path, environment=environment)

    return make

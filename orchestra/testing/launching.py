"""Launching a description in a test: a real `orchestra launch` in a domain and a home folder of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TypeAlias

from orchestra.testing.domain import free_domain
from orchestra.testing.run import Run
from orchestra.testing.stream import EventStream

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

# A launch file, or the content of one.
Description: TypeAlias = str | os.PathLike[str] | Mapping[str, Any]


@contextmanager
def launched(
    description: Description, *words: str, home: Path, environment: Mapping[str, str] | None = None
) -> Iterator[Run]:
    """Launch a description and end it again; `words` follow the file on the command line.

    `home` is a folder for this run alone. The run talks on this machine only, in a ROS domain that nobody else uses;
    `ROS_DOMAIN_ID` in the caller's environment is respected. `environment` is added to the caller's. At the end the
    run is stopped, unless it has ended, and has to have ended well with nothing left of it (`Run.finish`).
    """
    home.mkdir(parents=True, exist_ok=True)
    given = {**os.environ, **(environment or {})}
    with free_domain(given) as domain:
        run = _start([file_of(description, home), *words], given, home, domain)
        try:
            yield run
        except BaseException as error:
            _finish_after(error, run)
            raise
        run.finish()


def _finish_after(error: BaseException, run: Run) -> None:
    """End a run whose test has failed: what failed there is told first."""
    try:
        run.finish()
    except AssertionError as unclean:
        error.add_note(f"besides: {unclean}")


def _start(words: list[str], given: Mapping[str, str], home: Path, domain: int) -> Run:
    """Start `orchestra launch`; it has no terminal, and a session of its own, so that it hears no Ctrl-C but ours."""
    environment = {
        "NO_COLOR": "1",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        **given,
        "ORCHESTRA_HOME": str(home),
        "ROS_DOMAIN_ID": str(domain),
    }
    output = home / "output.txt"
    with output.open("wb") as screen:
        process = subprocess.Popen(  # noqa: S603 - the words are the test's own
            [sys.executable, "-m", "orchestra.testing.child", "launch", *words],
            stdin=subprocess.DEVNULL,
            stdout=screen,
            stderr=subprocess.STDOUT,
            env={**environment, "ORCHESTRA_TEST_SESSION": str(os.getpid())},
            start_new_session=True,
        )
    return Run(process, EventStream(home), output, environment)


def file_of(description: Description, home: Path) -> str:
    """Return the path of a description; content is written to a file, as JSON, which is YAML too."""
    if not isinstance(description, Mapping):
        return os.fspath(description)
    file = home / "description.launch.yaml"
    file.write_text(json.dumps(description, indent=2), "utf-8")
    return str(file)

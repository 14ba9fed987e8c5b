"""Writers that end with their test."""

from __future__ import annotations

from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from orchestra.logs.writer import Writer

if TYPE_CHECKING:
    from collections.abc import Iterator

Failures = list[tuple[Path, OSError]]


@contextmanager
def writing(failures: Failures | None = None) -> Iterator[Writer]:
    """A writer whose failures are collected where that is wanted, and are faults otherwise."""

    def failed(path: Path, error: OSError) -> None:
        if failures is None:
            raise AssertionError(f"{path}: {error}")
        failures.append((path, error))

    writer = Writer(failed)
    try:
        yield writer
    finally:
        writer.finish(5.0, 20.0)
        writer.close()

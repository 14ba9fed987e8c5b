"""Measure, and print a table: `python -m benchmarks [--quick] [--figure NAME ...] [--json FILE] [--plots FOLDER]`."""

from __future__ import annotations

import argparse
import json
import signal
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final

from benchmarks import launching, report
from benchmarks.figure import Outcome, Sample, Site, UnableError
from benchmarks.table import measurements

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from benchmarks.figure import Figure, Measurement

_ROUNDS: Final = 7


def main(words: Sequence[str] | None = None) -> int:
    """Measure what is asked for; return 0."""
    asked = _asked(words)
    # A shell without job control starts what goes to the background deaf to SIGINT: so would be all that is measured.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    launching.compile_all()
    outcomes: list[Outcome] = []
    unable: list[tuple[Figure, str]] = []
    for measurement in measurements():
        wanted = [
            figure for figure in measurement.FIGURES if asked.figure is None or figure.name in asked.figure
        ]
        if not wanted:
            continue
        try:
            for outcome in _measured(measurement, wanted, asked):
                outcomes.append(outcome)
                print(report.line(outcome), file=sys.stderr, flush=True)
        except UnableError as error:
            unable += [(figure, str(error)) for figure in wanted]
    if outcomes:
        print(report.table(outcomes))
    for figure, reason in unable:
        print(f"{figure.name}: not measured: {reason}")
    if asked.json:
        asked.json.write_text(json.dumps(report.document(outcomes, unable), indent=2) + "\n")
    if asked.plots:
        _draw(outcomes, asked.plots)
    return 0


def _asked(words: Sequence[str] | None) -> argparse.Namespace:
    names = [figure.name for measurement in measurements() for figure in measurement.FIGURES]
    parser = argparse.ArgumentParser("python -m benchmarks", description="Measure what Orchestra costs.")
    parser.add_argument(
        "--figure", action="append", choices=names, help="measure this one alone; may be repeated"
    )
    parser.add_argument("--quick", action="store_true", help="one round of the smallest size, to try it out")
    parser.add_argument("--rounds", type=int, default=_ROUNDS, help="the median of so many counts")
    parser.add_argument(
        "--json", type=Path, metavar="FILE", help="write everything that was measured to a file"
    )
    parser.add_argument(
        "--plots", type=Path, metavar="FOLDER", help="measure several sizes, and draw each figure over them"
    )
    return parser.parse_args(words)


def _measured(
    measurement: Measurement, figures: Sequence[Figure], asked: argparse.Namespace
) -> Iterator[Outcome]:
    """Yield the outcome of each figure at each size."""
    first = figures[0]
    sizes = [first.smallest] if asked.quick else [first.size]
    if asked.plots and not asked.quick:
        sizes = sorted({*first.sizes, first.size})
    rounds = 1 if asked.quick else min(asked.rounds, first.rounds or asked.rounds)
    for size in sizes:
        samples: dict[str, list[Sample]] = {figure.name: [] for figure in figures}
        for _ in range(rounds):
            for name, sample in _round(measurement, size).items():
                if name in samples:
                    samples[name].append(sample)
        for figure in figures:
            yield Outcome(figure, size, tuple(samples[figure.name]))


def _round(measurement: Measurement, size: int) -> dict[str, Sample]:
    with tempfile.TemporaryDirectory(prefix="benchmark-") as scratch:
        folder = Path(scratch).resolve()
        return dict(measurement.measure(Site(folder, launching.environment(folder)), size))


def _draw(outcomes: Sequence[Outcome], folder: Path) -> None:
    from benchmarks import plots  # noqa: PLC0415 - matplotlib is wanted for nothing else

    folder.mkdir(parents=True, exist_ok=True)
    for name in dict.fromkeys(outcome.figure.name for outcome in outcomes):
        print(plots.plot([outcome for outcome in outcomes if outcome.figure.name == name], folder))


if __name__ == "__main__":
    sys.exit(main())

"""Each figure is measured once at its smallest size: that it works and has its floor. Times are not judged."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING

import pytest

from benchmarks import launching, report
from benchmarks.__main__ import main
from benchmarks.figure import Figure, Outcome, Sample, Site, UnableError, Way
from benchmarks.table import measurements

if TYPE_CHECKING:
    from pathlib import Path

    from benchmarks.figure import Measurement

ALL = list(measurements())


@pytest.mark.timeout(300)
@pytest.mark.parametrize("measurement", ALL, ids=[measurement.FIGURES[0].name for measurement in ALL])
def test_a_figure_is_measured_beside_its_floor(measurement: Measurement, tmp_path: Path) -> None:
    size = measurement.FIGURES[0].smallest
    try:
        samples = measurement.measure(Site(tmp_path, launching.environment(tmp_path)), size)
    except UnableError as reason:
        pytest.skip(str(reason))
    assert set(samples) == {figure.name for figure in measurement.FIGURES}
    for figure in measurement.FIGURES:
        sample = samples[figure.name]
        outcome = Outcome(figure, figure.size, (sample,))
        assert sample.ours > 0 or figure.name == "wake-ups"
        assert (sample.floor is None) == (figure.way == "value")
        assert math.isfinite(outcome.comes_to)
        assert figure.title in report.table([outcome])


def test_names_are_given_once() -> None:
    names = [figure.name for measurement in ALL for figure in measurement.FIGURES]
    assert len(names) == len(set(names))
    assert all(figure.size in figure.sizes for measurement in ALL for figure in measurement.FIGURES)


@pytest.mark.parametrize(
    ("way", "ours", "floor", "comes_to"),
    [
        ("ratio", 6.0, 2.0, 3.0),
        ("difference", 6.0, 2.0, 4.0),
        ("exponent", 200.0, 2.0, 2.0),
        ("value", 6.0, None, 6.0),
    ],
)
def test_what_a_bar_is_held_to(way: Way, ours: float, floor: float | None, comes_to: float) -> None:
    figure = Figure("f", "title", "floor", way, 3.0, "s", 10, (10,), 1)
    samples = tuple(Sample(value, floor) for value in (ours, ours * 9, ours / 9))
    outcome = Outcome(figure, 10, samples)
    assert outcome.comes_to == pytest.approx(comes_to)
    assert outcome.met is (comes_to <= 3.0)
    assert Outcome(figure, 1, samples).met is None


def test_the_command_prints_a_table_and_writes_what_it_measured(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["--quick", "--figure", "short-processes", "--json", str(tmp_path / "out.json")]) == 0
    printed = capsys.readouterr()
    assert "| 1,000 short processes, started to all ended |" in printed.out
    assert "short-processes (5): " in printed.err
    document = json.loads((tmp_path / "out.json").read_text())
    (figure,) = document["figures"]
    assert (figure["name"], figure["size"], len(figure["samples"])) == ("short-processes", 5, 1)
    assert figure["comes_to"] == pytest.approx(figure["ours"] / figure["floor"])


def test_figures_are_drawn_over_their_size(tmp_path: Path) -> None:
    plots = pytest.importorskip("benchmarks.plots", exc_type=ImportError)
    figure = Figure("f", "title", "floor", "ratio", 3.0, "s", 20, (10, 20), 1)
    outcomes = [Outcome(figure, size, (Sample(size / 10, 1.0),)) for size in figure.sizes]
    assert plots.plot(outcomes, tmp_path).read_text().startswith("<?xml")

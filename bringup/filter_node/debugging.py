"""Writes down what becomes of each measurement, for `debug: true`."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np

from bringup.filter.estimator import Snapshot
from bringup.filter.localization import Localization
from bringup.filter.measurement import Measurement
from bringup.filter.settings import NANOSECONDS
from bringup.filter.state import NAMES

Logger: TypeAlias = Any


@contextmanager
def traced(file: str | None, localization: Localization, logger: Logger) -> Iterator[None]:
    """Write a trace to a file (None: to none); one that cannot be written is only complained about."""
    if file is None:
        yield
        return
    try:
        output = Path(file).open("w", encoding="utf-8")  # noqa: SIM115 - closed below, where it could be opened
    except OSError as error:
        text = f"the debug file cannot be written: {error}"
        logger.warning(text)
        yield
        return
    with output:
        localization.trace(
            lambda measurement, after, accepted: print(
                told(measurement, after, accepted=accepted), file=output
            )
        )
        yield


def told(measurement: Measurement, after: Snapshot, *, accepted: bool) -> str:
    """Tell a measurement and the estimate after it, with standard deviations, in a few lines of text."""
    fate = "fused" if accepted else "beyond its rejection threshold"
    read = zip(
        measurement.indices.tolist(),
        measurement.values,
        np.sqrt(measurement.noise.diagonal()).tolist(),
        strict=True,
    )
    deviations = np.sqrt(after.covariance.diagonal().clip(0.0))
    estimate = zip(NAMES, after.state.tolist(), deviations.tolist(), strict=True)
    return "\n".join(
        (
            f"{measurement.stamp / NANOSECONDS:.9f} {measurement.part}: {fate}",
            "  read     "
            + "  ".join(f"{NAMES[index]} {value:.6g}+-{sigma:.3g}" for index, value, sigma in read),
            f"  estimate at {after.stamp / NANOSECONDS:.9f}",
            "           " + "  ".join(f"{name} {value:.6g}+-{sigma:.3g}" for name, value, sigma in estimate),
        )
    )

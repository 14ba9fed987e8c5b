from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from bringup.filter.localization import Localization
from bringup.filter.settings import NANOSECONDS
from bringup.filter_node.debugging import traced
from bringup.filter_node.throttle import Throttle

# lark, which the ROS wheels load, still imports a module that Python 3.11 has renamed.
pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")

Make = Callable[..., Any]


class Log:
    """Collects warnings."""

    def __init__(self) -> None:
        self.warnings: list[str] = []

    def warning(self, message: str) -> None:
        self.warnings.append(message)


def _run(localization: Localization, twist: Make, file: Path | None) -> list[str]:
    log = Log()
    with traced(str(file) if file else None, localization, log):
        for second, speed in ((1, 1.0), (2, 99.0)):
            message = twist(second * NANOSECONDS, (speed, 0, 0, 0, 0, 0))
            localization.receive("twist0", message, 0)
            localization.update(second * NANOSECONDS)
    return log.warnings


@pytest.fixture
def localization(filter_of: Callable[..., Localization], config: Make) -> Localization:
    return filter_of(twist0="t", twist0_config=config("vx"), twist0_rejection_threshold=3.0)


def test_a_trace_tells_each_measurement_and_the_estimate_after_it(
    localization: Localization, twist: Make, tmp_path: Path
) -> None:
    assert _run(localization, twist, tmp_path / "trace.txt") == []
    first, read, _, estimate, second, *_ = (tmp_path / "trace.txt").read_text().splitlines()
    assert first == "1.000000000 twist0: fused"
    assert read == "  read     X_VELOCITY 1+-0.001"
    assert "X_VELOCITY 1+-0.001" in estimate
    assert second == "2.000000000 twist0: beyond its rejection threshold"


def test_without_a_file_nothing_is_traced(localization: Localization, twist: Make, tmp_path: Path) -> None:
    assert _run(localization, twist, None) == []
    assert list(tmp_path.iterdir()) == []


def test_a_file_that_cannot_be_written_is_a_warning(
    localization: Localization, twist: Make, tmp_path: Path
) -> None:
    (warning,) = _run(localization, twist, tmp_path / "missing" / "trace.txt")
    assert warning.startswith("the debug file cannot be written")
    assert localization.estimate() is not None


def test_a_throttle_lets_one_complaint_pass_in_its_time() -> None:
    times = iter((0.0, 1.0, 4.9, 5.0, 6.0, 10.0))
    throttle = Throttle(5.0, lambda: next(times))
    assert [throttle.passes() for _ in range(6)] == [True, False, False, True, False, True]

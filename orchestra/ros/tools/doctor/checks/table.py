"""Which checks there are, in the order in which they are made."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, TypeAlias

from orchestra.ros.tools.doctor.checks import (
    answers,
    clock,
    frames,
    names,
    qos,
    settings,
    time,
    types,
    unmatched,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from orchestra.ros.tools.doctor.observed import Finding, Observed

    Check: TypeAlias = Callable[[Observed], Iterator[Finding]]

CHECKS: Final[dict[str, Check]] = {
    "qos": qos.check,
    "types": types.check,
    "unmatched": unmatched.check,
    "names": names.check,
    "answers": answers.check,
    "time": time.check,
    "clock": clock.check,
    "frames": frames.check,
    "settings": settings.check,
}

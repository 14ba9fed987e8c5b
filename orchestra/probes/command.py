"""Ready when a command exits with 0."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING

from orchestra.probes.repeated import Repeated

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from orchestra.probes.protocol import Cancel, Site

# How long one attempt may take, in seconds.
WITHIN = 5.0


def command_probe(words: Sequence[str], interval: float) -> Repeated:
    """Return the condition that a command, in the environment and the working directory of the process, succeeds."""

    def attempt(site: Site, told: Callable[[str | None], None]) -> Cancel:
        return site.run(words, WITHIN, lambda result: told(result.fault))

    return Repeated(f"the command {shlex.join(words)}", attempt, interval)

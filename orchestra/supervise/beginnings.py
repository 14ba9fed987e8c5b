"""What the supervisor is given when it begins."""

from __future__ import annotations

import os
import time

TYPE_CHECKING = False
if TYPE_CHECKING:
    from orchestra.supervise.attendance import Attend
    from orchestra.supervise.keeping.patience import Patience
    from orchestra.supervise.keeping.stacks import Stacks
    from orchestra.supervise.resolver.process import Resolver
    from orchestra.supervise.summons import Summons
    from orchestra.supervise.warm.launching import Launched


class Kept:
    """What connects the supervisor with its keeper: the keeper's pid, the run's mark, what both share."""

    __slots__ = ("keeper", "patience", "run_id", "stacks")

    def __init__(self, keeper: int, run_id: str, patience: Patience, stacks: Stacks) -> None:
        self.keeper = keeper
        self.run_id = run_id
        self.patience = patience
        self.stacks = stacks


class Beginnings:
    """The run's mark, the keeper's pid, the descriptor on which signals arrive as bytes.

    `resolver` is at work;
    `began` is now, in seconds since the epoch;
    `stacks` is where our processes write where they are; `attend` is what attends to the run besides;
    `summons` what the service manager wants that has started us;
    `ahead` is the fork server, where it has been started already.
    """

    __slots__ = (
        "_patience",
        "ahead",
        "attend",
        "began",
        "keeper",
        "resolver",
        "run_id",
        "signals",
        "stacks",
        "summons",
    )

    def __init__(
        self,
        kept: Kept,
        resolver: Resolver,
        signals: int,
        attend: Attend | None,
        summons: Summons,
        ahead: Launched | None = None,
    ) -> None:
        self.began = time.time()
        self.run_id = kept.run_id
        self.keeper = kept.keeper
        self.stacks = kept.stacks
        self.resolver = resolver
        self.signals = signals
        self.attend = attend
        self.summons = summons
        self.ahead = ahead
        self._patience = kept.patience

    def orphaned(self) -> bool:
        """Tell whether the keeper is dead: then the run has to end as soon as usual, whatever was granted."""
        return os.getppid() != self.keeper

    def more_time(self, seconds: float) -> bool:
        """Ask the keeper to wait so long from now for the end of the run; tell whether there is one that will."""
        if self.orphaned():
            return False
        self._patience.grant(seconds)
        return True

    def settle(self, status: int) -> None:
        """Let the keeper know what the run has come to: it has been told, and nothing changes it any more."""
        self._patience.settle(status)

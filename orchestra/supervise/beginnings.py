"""What the supervisor is given when it begins."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from orchestra.supervise.attendance import Attend
    from orchestra.supervise.resolver import Resolver


class Beginnings:
    """The run's mark, the keeper's pid, the resolver at work, the descriptor on which signals arrive as bytes.

    `attend` is what attends to the run besides.
    """

    __slots__ = ("attend", "keeper", "resolver", "run_id", "signals")

    def __init__(
        self, run_id: str, keeper: int, resolver: Resolver, signals: int, attend: Attend | None
    ) -> None:
        self.run_id = run_id
        self.keeper = keeper
        self.resolver = resolver
        self.signals = signals
        self.attend = attend

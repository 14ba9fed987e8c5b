"""What a process may use, and where it runs."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from orchestra.description.conflict import Conflict
from orchestra.description.entity import Entity
from orchestra.description.fields import Flag, Text, text_or_list, word, worded
from orchestra.description.marks import Plain, Told
from orchestra.description.model import field
from orchestra.description.ranges import NICE, PRIORITY
from orchestra.description.text import Template

SCHEDULERS = ("other", "batch", "idle", "fifo", "rr")

_NUMBER = {"type": "integer", "minimum": 0}
_CORES = {"type": "string", "pattern": r"\$\(|^\[?[0-9][0-9, -]*\]?$"}
_AMOUNT = r"[0-9]+(\.[0-9]+)?\s*([KMGTkmgt](i?[Bb])?|[Bb])?"
_LIMIT = rf"({_AMOUNT}|unlimited)"

Cores: TypeAlias = Annotated[
    Template | tuple[Template, ...],
    Plain(text_or_list),
    Told(
        {
            "anyOf": [
                _NUMBER,
                _CORES,
                {"type": "array", "items": {"anyOf": [_NUMBER, _CORES]}, "minItems": 1},
            ]
        }
    ),
]
Size: TypeAlias = Annotated[
    Text,
    Told({"anyOf": [_NUMBER, {"type": "string", "pattern": rf"\$\(|^{_AMOUNT}$"}]}),
]
SizeOrUnlimited: TypeAlias = Annotated[
    Text,
    Told({"anyOf": [_NUMBER, {"type": "string", "pattern": rf"\$\(|^{_LIMIT}$"}]}),
]
Rlimit: TypeAlias = Annotated[
    Text,
    Told({"anyOf": [_NUMBER, {"type": "string", "pattern": rf"\$\(|^{_LIMIT}(:{_LIMIT})?$"}]}),
]


class Rlimits(Entity):
    """Limits of getrlimit(2): a number, `unlimited`, or soft and hard limit with a colon between them."""

    as_: Rlimit | None = field(default=None, alias="as", description="Address space, in bytes.")
    core: Rlimit | None = field(default=None, description="Size of a core file, in bytes.")
    cpu: Rlimit | None = field(default=None, description="Time on a processor, in seconds.")
    data: Rlimit | None = field(default=None, description="Data segment, in bytes.")
    fsize: Rlimit | None = field(default=None, description="Size of a file that it writes, in bytes.")
    memlock: Rlimit | None = field(default=None, description="Memory that it keeps from swapping, in bytes.")
    msgqueue: Rlimit | None = field(default=None, description="POSIX message queues of its user, in bytes.")
    nice: Rlimit | None = field(default=None, description="20 minus the least `nice` that it may set.")
    nofile: Rlimit | None = field(default=None, description="Open files, one more than the highest number.")
    nproc: Rlimit | None = field(default=None, description="Processes and threads of its user.")
    rss: Rlimit | None = field(default=None, description="Resident memory, in bytes; Linux ignores it.")
    rtprio: Rlimit | None = field(default=None, description="Highest real-time priority that it may set.")
    rttime: Rlimit | None = field(
        default=None, description="Real-time work without a pause, in microseconds."
    )
    sigpending: Rlimit | None = field(default=None, description="Signals that may be queued for its user.")
    stack: Rlimit | None = field(default=None, description="Stack, in bytes.")


class Limits(Entity):
    """What a process may use, and where it runs; what is not said stays as it is inherited."""

    cores: Cores | None = field(
        default=None, description="Logical processors that it may run on: a list, or ranges as `0-3,6`."
    )
    exclusive: Flag | None = field(
        default=None, description="Whether no other process of the run is given these cores."
    )
    nice: Annotated[Template, NICE] | None = field(
        default=None, description="Nice value, from -20 (first) to 19 (last)."
    )
    scheduler: Annotated[Template, Plain(word(*SCHEDULERS)), worded(*SCHEDULERS)] | None = field(
        default=None, description="Scheduling policy; `fifo` and `rr` are the real-time ones."
    )
    priority: Annotated[Template, PRIORITY] | None = field(
        default=None, description="Real-time priority from 1 to 99, for `fifo` and `rr`."
    )
    memory: Size | None = field(
        default=None, description="Most memory of it and all it starts: bytes, or as `512M`, `2G`."
    )
    memory_lock: SizeOrUnlimited | None = field(
        default=None, description="Memory that it may keep from swapping: a size, or `unlimited`."
    )
    rlimits: Rlimits | None = field(default=None, description="Limits of getrlimit(2), by their names.")

    def conflict(self) -> Conflict | None:
        """Return which keys cannot stand without or beside another."""
        if self.exclusive is not None and self.cores is None:
            return Conflict("`exclusive` goes with `cores`", ("exclusive",))
        if self.priority is not None and self.scheduler is None:
            return Conflict("`priority` goes with `scheduler: fifo` or `scheduler: rr`", ("priority",))
        if self.memory_lock is not None and self.rlimits is not None and self.rlimits.memlock is not None:
            reason = "`memory_lock` and `memlock` of `rlimits` say the same thing: leave one of them out"
            return Conflict(reason, ("memory_lock", "rlimits"))
        return None

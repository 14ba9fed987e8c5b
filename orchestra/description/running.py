"""What `node` and `executable` have in common: how a process is run."""

from __future__ import annotations

from typing import Annotated

from orchestra.description.conditions import Alive, Ready
from orchestra.description.conflict import Conflict
from orchestra.description.entity import Action
from orchestra.description.fields import Argv, Flag, Integer, Seconds, Text, word, worded
from orchestra.description.limits import Limits
from orchestra.description.marks import Plain
from orchestra.description.model import field
from orchestra.description.outputs import Output
from orchestra.description.parts import DependsOn, Pair, Restart, Stop
from orchestra.description.short import Short
from orchestra.description.text import Template

ON_EXIT = ("shutdown",)
_RESPAWN = ("respawn", "respawn_delay", "respawn_max_retries")


class Running(Action):
    """An action that starts a process."""

    name: Text | None = field(default=None, description="Name of the node, or label of the process.")
    cwd: Text | None = field(default=None, description="Working directory.")
    env: tuple[Pair, ...] = field(default=(), description="Environment variables of this process.")
    env_only: tuple[Pair, ...] | None = field(
        default=None, description="The whole environment of this process, beside `env`: it inherits nothing."
    )
    launch_prefix: Argv | None = field(
        default=None, description="Command that the process is started with, as gdb."
    )
    shell: Flag | None = field(default=None, description="Whether a shell reads the command.")
    emulate_tty: Flag | None = field(default=None, description="Whether its output is a terminal.")
    output: Output | None = field(
        default=None, description="Where its output goes; `both` (screen and log) where absent."
    )
    on_exit: Annotated[Template, Plain(word(*ON_EXIT)), worded(*ON_EXIT)] | None = field(
        default=None, description="End the run when the process ends."
    )
    respawn: Flag | None = field(default=None, description="Start it again whenever it ends.")
    respawn_delay: Seconds | None = field(
        default=None, description="Least delay before a respawn, in seconds."
    )
    respawn_max_retries: Integer | None = field(
        default=None, description="Number of respawns; negative: for ever."
    )
    sigterm_timeout: Seconds | None = field(default=None, description="Seconds from SIGINT to SIGTERM.")
    sigkill_timeout: Seconds | None = field(default=None, description="Seconds from SIGTERM to SIGKILL.")

    depends_on: tuple[DependsOn, ...] = field(
        default=(), description="What must come about before it starts."
    )
    ready: Ready | None = field(default=None, description="When it counts as ready.")
    alive: Alive | None = field(default=None, description="Signs of life that it gives once it is ready.")
    restart: Annotated[Restart, Short("policy")] | None = field(
        default=None, description="When it is started again."
    )
    required: Flag | None = field(default=None, description="Whether its end ends the run, with its status.")
    stop: Stop | None = field(default=None, description="How it is ended.")
    success_exit_codes: tuple[Integer, ...] | None = field(
        default=None, description="Statuses that are no failure."
    )
    stdin: Flag | None = field(
        default=None, description="Whether it reads what is typed; one process of a run may."
    )
    warm: Flag | None = field(
        default=None,
        description="Whether it may be forked from a process that has the imports of nodes; where absent, a node in"
        " Python is, unless that would make a difference.",
    )
    limits: Limits | None = field(default=None, description="What it may use, and where it runs.")

    def conflict(self) -> Conflict | None:
        """Return a key of upstream's beside `restart`: which of the two counts cannot be told."""
        upstream = [key for key in _RESPAWN if getattr(self, key) is not None]
        if self.restart is None or not upstream:
            return super().conflict()
        reason = f"`{upstream[0]}` and `restart` say the same thing twice: leave one of them out"
        return Conflict(reason, ("restart", *upstream))

"""Keys of a process that do nothing because of others beside them, or because others are missing."""

from __future__ import annotations

from operator import attrgetter
from typing import TYPE_CHECKING

from orchestra.description.text import Template
from orchestra.errors import Code
from orchestra.location import is_python

if TYPE_CHECKING:
    from collections.abc import Iterator

    from orchestra.description.running import Running
    from orchestra.location import Location
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import Restart


# What only does something beside others, or keeps others from it.
_concerned = attrgetter("restart", "respawn_delay", "respawn_max_retries", "stop", "stdin")


def check_keys(action: Running, restart: Restart | None, location: Location, run: Resolution) -> None:
    """Report keys of an action that never act. Calls in Python give arguments in bulk: theirs are left alone."""
    if (restart is None and not any(_concerned(action))) or is_python(location):
        return
    for written, message in _idle(action, restart, run):
        run.problems.warning(Code.IDLE_KEY, message, run.at(written.span))


def _idle(action: Running, restart: Restart | None, run: Resolution) -> Iterator[tuple[Template, str]]:
    yield from _without_respawn(action)
    yield from _beside_stop(action)
    yield from _never_restarted(action, restart)
    yield from _unseen(action, run)
    if restart is None or restart.policy != "always" or restart.budget is not None:
        return
    again = "`respawn`" if action.respawn is not None else "`restart: always`"
    if action.on_exit is not None:
        yield (
            action.on_exit,
            f"`on_exit` ends the run whenever the process ends: {again} beside it never acts",
        )
    elif action.required is not None and run.flag(action.required) is True:
        yield action.required, f"{again} starts the process again whenever it ends: `required` never acts"


def _unseen(action: Running, run: Resolution) -> Iterator[tuple[Template, str]]:
    """Yield an output that hides what the user is to answer."""
    if not isinstance(action.output, Template) or action.output.constant not in ("log", "own_log"):
        return
    if action.stdin is not None and run.flag(action.stdin) is True:
        word = action.output.constant
        yield action.output, f"`output: {word}` keeps from the screen what `stdin` lets the user answer"


def _without_respawn(action: Running) -> Iterator[tuple[Template, str]]:
    if action.respawn is not None or action.restart is not None or action.faulty:
        return  # a faulty one may have been meant to be `respawn`
    for name in ("respawn_delay", "respawn_max_retries"):
        written = getattr(action, name)
        if written is not None:
            yield written, f"`{name}` does nothing without `respawn: true`"


def _beside_stop(action: Running) -> Iterator[tuple[Template, str]]:
    if action.stop is None:
        return
    for name, other in (("sigterm_timeout", "timeout"), ("sigkill_timeout", "kill_timeout")):
        written = getattr(action, name)
        if written is not None and getattr(action.stop, other) is not None:
            yield written, f"`{name}` does nothing beside `{other}` of `stop`, which says the same"


def _never_restarted(action: Running, restart: Restart | None) -> Iterator[tuple[Template, str]]:
    if restart is None or action.restart is None or restart.policy != "no":
        return
    for name in ("delay", "max_delay", "min_uptime", "growth", "jitter", "budget"):
        written = getattr(action.restart, name)
        if written is not None:
            yield written, f"`{name}` does nothing with the policy `no`"

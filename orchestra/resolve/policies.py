"""How a process is started again and how it is ended, from Orchestra's keys and upstream's."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from orchestra.description.parts import POLICIES
from orchestra.description.ranges import BUDGET, GROWTH, SHARE
from orchestra.errors import Code
from orchestra.nearest import nearest
from orchestra.resolve.amounts import amount, whole
from orchestra.resolve.context import POISON, Poison, Value
from orchestra.resolve.refusals import refuse_value
from orchestra.resolve.sound import Sound
from orchestra.values import Restart, Stop

if TYPE_CHECKING:
    from orchestra.description.running import Running
    from orchestra.description.text import Template
    from orchestra.resolve.resolution import Resolution
    from orchestra.values import Policy

_DEFAULT_RESTART = Restart("no")
_DEFAULT_STOP = Stop()
_FOR_ALL = ("sigterm_timeout", "sigkill_timeout")


def restart(action: Running, run: Resolution) -> Restart | Poison | None:
    """Return when the process starts again; upstream's `respawn` is `always`, with a delay that grows."""
    if action.restart is None:
        return _respawn(action, run)
    written, sound = action.restart, Sound()
    policy, delay = sound(run.word(written.policy, POLICIES)), sound(run.number(written.delay))
    max_delay, min_uptime = sound(run.number(written.max_delay)), sound(run.number(written.min_uptime))
    growth, jitter = sound(amount(written.growth, GROWTH, run)), sound(amount(written.jitter, SHARE, run))
    budget = sound(whole(written.budget, BUDGET, run))
    if sound.faulty or policy is None or written.faulty:
        return POISON
    if max_delay is not None and delay is not None and max_delay < delay:
        place = run.at((written.max_delay or written).span)
        message = f"the longest delay, {max_delay:g} s, is shorter than the first one, {delay:g} s"
        run.problems.error(Code.CONFLICTING_KEYS, message, place)
        return POISON
    return Restart(
        cast("Policy", policy),
        _or(delay, _DEFAULT_RESTART.delay),
        max(_or(max_delay, _DEFAULT_RESTART.max_delay), delay or 0.0),
        _or(min_uptime, _DEFAULT_RESTART.min_uptime),
        budget,
        _or(growth, _DEFAULT_RESTART.growth),
        _or(jitter, _DEFAULT_RESTART.jitter),
    )


def _respawn(action: Running, run: Resolution) -> Restart | Poison | None:
    if action.respawn is None and action.respawn_delay is None and action.respawn_max_retries is None:
        return None
    respawn, delay = run.flag(action.respawn, default=False), run.number(action.respawn_delay)
    retries = run.integer(action.respawn_max_retries)
    if isinstance(respawn, Poison) or isinstance(delay, Poison) or isinstance(retries, Poison):
        return POISON
    if not respawn:
        return None
    least = delay or 0.0
    budget = retries if retries is not None and retries >= 0 else None
    return Restart("always", least, max(_DEFAULT_RESTART.max_delay, least), budget=budget)


def stop(action: Running, run: Resolution) -> Stop | Poison | None:
    """Return how the process is ended, None where nothing is said."""
    written = action.stop
    if (written, action.sigterm_timeout, action.sigkill_timeout) == (
        None,
        None,
        None,
    ) and run.scope.variables.keys().isdisjoint(_FOR_ALL):
        return None
    name = run.evaluate(written.signal) if written is not None else None
    timeout = run.number(_first(written.timeout if written else None, action.sigterm_timeout))
    kill_timeout = run.number(_first(written.kill_timeout if written else None, action.sigkill_timeout))
    if timeout is None:
        timeout = _setting("sigterm_timeout", run)
    if kill_timeout is None:
        kill_timeout = _setting("sigkill_timeout", run)
    number = _signal(name, run) if isinstance(name, Value) else name
    if isinstance(number, Poison) or isinstance(timeout, Poison) or isinstance(kill_timeout, Poison):
        return POISON
    if number is None and timeout is None and kill_timeout is None:
        return None
    return Stop(
        number or _DEFAULT_STOP.signal,
        _or(timeout, _DEFAULT_STOP.timeout),
        _or(kill_timeout, _DEFAULT_STOP.kill_timeout),
    )


def _signal(value: Value, run: Resolution) -> str | Poison:
    """Return the full name of a signal that is written with or without SIG, or as a number."""
    import signal  # noqa: PLC0415 - half a millisecond, and few say which

    text = value.text.strip().upper()
    names = {item.name for item in signal.Signals}
    if text.isdigit() and int(text) in {item.value for item in signal.Signals}:
        return signal.Signals(int(text)).name
    name = text if text.startswith("SIG") else f"SIG{text}"
    if name in names:
        return name
    message = f"there is no signal '{value.text}'"
    return refuse_value(value, run.problems, Code.BAD_VALUE, message, meant=nearest(name, names))


def _setting(name: str, run: Resolution) -> float | Poison | None:
    """Return a number of seconds that a launch argument of upstream's sets for all processes."""
    variable = run.scope.variables.get(name)
    if variable is None or not isinstance(variable.value, Value):
        return None
    try:
        return max(0.0, float(variable.value.text))
    except ValueError:
        message = f"'{name}' is a number of seconds, not '{variable.value.text}'"
        run.problems.error(Code.BAD_VALUE, message, variable.value.location)
        return POISON


def _first(one: Template | None, other: Template | None) -> Template | None:
    return one if one is not None else other


def _or(value: float | None, default: float) -> float:
    return default if value is None else value
